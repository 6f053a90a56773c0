"""The command line: ``python -m foldmotion`` and the console script ``foldmotion``."""

import sys

from foldmotion._native import main as _main


def main() -> int:
    """Run the command line and return its exit status."""
    sys.stdout.flush()
    return _main(["foldmotion", *sys.argv[1:]])


if __name__ == "__main__":
    sys.exit(main())
