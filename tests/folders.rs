//! Data flows one way: no file of `src` uses a folder that stands further down in the table of `src/lib.rs`.

use std::fs;
use std::path::{Path, PathBuf};

fn source() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("src")
}

/// The folders in the order of the table.
fn order() -> Vec<String> {
    let text = fs::read_to_string(source().join("lib.rs")).expect("src/lib.rs is readable");
    let rows = text.lines().filter_map(|line| line.strip_prefix("//! | ")?.split(" |").next());
    rows.map(|name| name.trim_matches(['`', '[', ']']).into()).filter(|name| name != "folder").collect()
}

/// Every file of Rust below a folder.
fn files(folder: &Path) -> Vec<PathBuf> {
    let entries = fs::read_dir(folder).unwrap_or_else(|e| panic!("{}: {e}", folder.display()));
    let paths = entries.map(|entry| entry.expect("a readable folder").path());
    paths.flat_map(|path| if path.is_dir() { files(&path) } else { vec![path] }).collect()
}

/// The modules of the crate that code names. A re-export (`pub use`) names what users find there, and nothing flows
/// by it; tests may use all.
fn used(text: &str) -> Vec<&str> {
    let code = text.split("#[cfg(test)]").next().unwrap_or_default();
    let lines =
        code.lines().map(str::trim_start).filter(|line| !line.starts_with("//") && !line.starts_with("pub use"));
    let names = lines.flat_map(|line| line.split("crate::").skip(1));
    names.map(|rest| rest.split(|c: char| !(c.is_alphanumeric() || c == '_')).next().unwrap_or_default()).collect()
}

/// What uses what comes later: folder, used folder, file.
fn against(order: &[String]) -> Vec<(String, String, PathBuf)> {
    let place = |name: &str| order.iter().position(|folder| folder == name);
    let mut found = Vec::new();
    for (own, folder) in order.iter().enumerate().filter(|(_, folder)| source().join(folder).is_dir()) {
        for file in files(&source().join(folder)) {
            let text = fs::read_to_string(&file).unwrap_or_else(|e| panic!("{}: {e}", file.display()));
            let later = used(&text).into_iter().filter(|name| place(name).is_some_and(|other| other > own));
            found.extend(later.map(|name| (folder.clone(), name.to_owned(), file.clone())));
        }
    }
    found
}

#[test]
fn no_file_uses_a_later_folder() {
    let found = against(&order());
    assert!(found.is_empty(), "the table of src/lib.rs has these the other way round: {found:?}");
}

#[test]
fn every_folder_is_in_the_table() {
    let order = order();
    for entry in fs::read_dir(source()).expect("src is readable").map(|entry| entry.expect("a readable folder").path())
    {
        let name = entry.file_name().and_then(|name| name.to_str()).expect("a name");
        assert!(!entry.is_dir() || order.iter().any(|folder| folder == name), "src/{name} is not in the table");
    }
}

/// Turned round, the table must be refused: the test sees what is used.
#[test]
fn the_order_turned_round_is_refused() {
    let turned: Vec<String> = order().into_iter().rev().collect();
    assert!(against(&turned).len() > 100);
}

#[test]
fn names_are_read_from_code_alone() {
    assert_eq!(
        used("use crate::pair::Pair;\n// crate::patch\npub use crate::rock::X;\nlet a = crate::model::f();"),
        ["pair", "model"]
    );
}
