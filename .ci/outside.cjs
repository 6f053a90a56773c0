// The Khronos glTF validator on each file named: fails where it finds an error or a warning.
const { readFileSync } = require('node:fs');
const validator = require('gltf-validator');

(async () => {
  for (const file of process.argv.slice(2)) {
    const { issues, info } = await validator.validateBytes(new Uint8Array(readFileSync(file)));
    console.log(`${file}: ${issues.numErrors} errors, ${issues.numWarnings} warnings, ${info.animationCount} animation`);
    if (issues.numErrors + issues.numWarnings > 0) {
      console.log(JSON.stringify(issues.messages.slice(0, 10), null, 1));
      process.exitCode = 1;
    }
  }
})();
