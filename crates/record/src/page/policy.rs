//! What the browser may do with a page: Content Security Policy (W3C 2024, Level 3).

use sha2::{Digest, Sha256};

use super::payload::base64;

/// The policy of a page with these styles and scripts: no others run, and nothing is fetched.
pub(super) fn policy(styles: &str, scripts: &[&str]) -> String {
    let hash = |text: &str| format!("'sha256-{}'", base64(&Sha256::digest(text.as_bytes())));
    let scripts: Vec<String> = scripts.iter().map(|script| hash(script)).collect();
    format!(
        "default-src 'none'; img-src data:; style-src {}; script-src {}; base-uri 'none'; form-action 'none'",
        hash(styles),
        scripts.join(" ")
    )
}
