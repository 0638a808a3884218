//! Numbers the sources of each pass, so that a record says which code it was measured with.

use std::fs;
use std::path::{Path, PathBuf};

fn main() -> std::io::Result<()> {
    println!("cargo:rerun-if-changed=.");
    let out = PathBuf::from(std::env::var_os("OUT_DIR").unwrap_or_default());
    fs::write(out.join("sources.rs"), sources(Path::new(".")))
}

/// Stage, pass and number of each pass in `root`, as Rust text. What a stage has beside its passes counts for all of them:
/// its `mod.rs` may hold what their functions call, and a pass more in its list costs no more than measuring again.
pub fn sources(root: &Path) -> String {
    let of_all = mixed(mixed(0xcbf2_9ce4_8422_2325, &root.join("shared")), &root.join("ports.rs"));
    let mut lines = String::from("&[\n");
    for stage in folders(root) {
        let files = entries(&stage).into_iter().filter(|path| path.is_file());
        let of_stage = files.fold(of_all, |hash, file| mixed(hash, &file));
        for pass in folders(&stage) {
            let hash = mixed(of_stage, &pass);
            lines += &format!("    ({:?}, {:?}, \"{hash:016x}\"),\n", name(&stage), name(&pass));
        }
    }
    lines + "]\n"
}

fn name(path: &Path) -> String {
    path.file_name().unwrap_or_default().to_string_lossy().into_owned()
}

fn entries(folder: &Path) -> Vec<PathBuf> {
    let mut entries: Vec<_> = fs::read_dir(folder).into_iter().flatten().flatten().map(|entry| entry.path()).collect();
    entries.sort();
    entries
}

fn folders(folder: &Path) -> Vec<PathBuf> {
    entries(folder).into_iter().filter(|path| path.is_dir() && name(path) != "shared").collect()
}

/// `hash` with a file, or with names and contents of a folder: 64-bit FNV-1a. Tests change nothing that runs.
fn mixed(hash: u64, path: &Path) -> u64 {
    let mix = |hash: u64, bytes: &[u8]| {
        bytes.iter().fold(hash, |hash, byte| (hash ^ u64::from(*byte)).wrapping_mul(0x0000_0100_0000_01b3))
    };
    match path.is_dir() {
        true => entries(path).iter().fold(hash, |hash, entry| mixed(hash, entry)),
        false if name(path).starts_with("tests") => hash,
        false => mix(mix(hash, name(path).as_bytes()), &fs::read(path).unwrap_or_default()),
    }
}
