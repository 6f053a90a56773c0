//! Tells the tests whether a GPU is at hand: FOLDMOTION_GPU_TESTS=yes.

fn main() {
    println!("cargo::rerun-if-changed=build.rs");
    println!("cargo::rerun-if-env-changed=FOLDMOTION_GPU_TESTS");
    println!("cargo::rustc-check-cfg=cfg(gpu_tests)");
    if std::env::var("FOLDMOTION_GPU_TESTS").is_ok_and(|value| value == "yes") {
        println!("cargo::rustc-cfg=gpu_tests");
    }
}
