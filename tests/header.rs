//! The committed C header is the one that cbindgen makes of `src/capi` and of the structs and flags of the library, and
//! it names this version.

use potential_particles::internals::comment_with;
use std::path::{Path, PathBuf};
use std::{env, fs};

/// Set to any value, it makes the test write the header instead of comparing it.
const WRITE: &str = "PP_WRITE_HEADER";
const REMEDY: &str = "make header";

fn root() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR"))
}

fn header_path() -> PathBuf {
    root().join("include/potential_particles.h")
}

fn committed() -> String {
    fs::read_to_string(header_path())
        .unwrap_or_else(|e| panic!("{}: {e}\nWrite it with\n    {REMEDY}", header_path().display()))
}

fn source(file: &str) -> String {
    fs::read_to_string(root().join(file)).unwrap_or_else(|e| panic!("{file}: {e}"))
}

/// A comment of the library with the names of C in the place of its links.
fn comment_in_c(line: &str) -> String {
    comment_with(line, |link| match link.split_once("::") {
        Some(("Flags", flag)) => format!("PP_FLAG_{flag}"),
        Some(("Role", body)) => format!("PP_ON_{body}"),
        Some((_, variant)) => {
            let apart = |c: char| if c.is_uppercase() { format!("_{c}") } else { c.to_uppercase().to_string() };
            format!("PP{}", variant.chars().map(apart).collect::<String>())
        }
        None if link == "Flags" => "PP_FLAG_... bits".into(),
        None if link == "Contact" => "struct pp_contact".into(),
        None if link == "PairState" => "pp_pair_state".into(),
        None if link == "PatchState" => "struct pp_patch_state".into(),
        None => panic!("{link}: no name in C"),
    })
}

/// The structs of the library that C has as they are: file, struct, name in C.
const STRUCTS: [(&str, &str, &str); 7] = [
    ("src/settings.rs", "Settings", "pp_settings"),
    ("src/contact/contact.rs", "Contact", "pp_contact"),
    ("src/contact/closest_point.rs", "ClosestPoint", "pp_closest"),
    ("src/boundary/contact.rs", "FlatContact", "pp_flat_contact"),
    ("src/patch/patch.rs", "PatchPoint", "pp_patch_point"),
    ("src/derivative/answer.rs", "ContactWeights", "pp_contact_weights"),
    ("src/derivative/answer.rs", "PoseGradient", "pp_pose_gradient"),
];

/// A struct of the library, alone or of an `answer!`, as a plain struct under its name in C.
fn struct_in_c((file, name, in_c): (&str, &str, &str)) -> String {
    let source = source(file);
    let is_doc = |line: &&str| line.starts_with("///");
    let lines: Vec<&str> = source.lines().map(str::trim_start).filter(|line| !line.starts_with("#[")).collect();
    let is_head = |line: &&str| {
        let rest = line.strip_prefix("pub struct ").and_then(|line| line.strip_prefix(name));
        rest.is_some_and(|rest| rest.starts_with(' '))
    };
    let head = lines.iter().rposition(is_head).unwrap_or_else(|| panic!("{file} has no struct {name}"));
    let docs = lines[..head].iter().rev().take_while(|line| is_doc(line)).count();
    let mut plain = String::from("#[repr(C)]\n");
    for line in &lines[head - docs..] {
        if is_head(line) {
            plain += &format!("pub struct {in_c} {{");
        } else if is_doc(line) {
            plain += &comment_in_c(line);
        } else {
            // Without the value that an answer has while nothing is known.
            plain += &line.split_once(" = ").map_or_else(|| (*line).into(), |(field, _)| format!("{field},"));
        }
        plain += "\n";
        if *line == "}" {
            break;
        }
    }
    let words = [("Kind", "i32"), ("Formulation", "u32"), ("BackEnd", "u32"), ("Flags", "u32"), ("Feature", "u32")];
    let plain = words.iter().fold(plain, |text, (of, by)| text.replace(&format!(": {of},"), &format!(": {by},")));
    plain.replace("Vector3<f64>", "[f64; 3]")
}

/// The flags of the library: file, type, and how their names begin in C.
const FLAGS: [(&str, &str, &str); 3] = [
    ("src/flags.rs", "Flags", "PP_FLAG_"),
    ("src/patch/patch.rs", "PatchFlags", "PP_PATCH_"),
    ("src/derivative/answer.rs", "DerivativeFlags", "PP_DERIVATIVE_"),
];

/// A set of flags as constants.
fn flags_in_c((file, name, prefix): (&str, &str, &str)) -> String {
    let source = source(file);
    let lines = source.lines().skip_while(|line| *line != format!("impl {name} {{")).map(str::trim_start);
    let (mut constants, mut comment) = (String::new(), String::new());
    for line in lines.take_while(|line| !line.starts_with("const ")) {
        if line.starts_with("///") {
            comment += &format!("{}\n", comment_in_c(line));
        } else if let Some((flag, bit)) =
            line.strip_prefix("pub const ").and_then(|rest| rest.split_once(": Self = Self"))
        {
            constants += &format!("{comment}pub const {prefix}{flag}: u32 = {bit}\n");
            comment.clear();
        }
    }
    assert!(!constants.is_empty(), "{file} has no flags {name}");
    constants
}

/// From `src/capi` and these structs and flags alone: other public items of the crate are no part of the C interface.
fn generated() -> String {
    let structs = Path::new(env!("CARGO_TARGET_TMPDIR")).join(format!("structs_{:?}.rs", std::thread::current().id()));
    fs::write(&structs, FLAGS.map(flags_in_c).concat() + &STRUCTS.map(struct_in_c).concat())
        .expect("the build folder is writable");
    let config = cbindgen::Config::from_file(root().join("cbindgen.toml")).expect("cbindgen.toml is readable");
    let sources = cbindgen::Builder::new().with_config(config).with_src(root().join("src/capi/mod.rs"));
    let mut text = Vec::new();
    sources.with_src(&structs).generate().expect("cbindgen reads src/capi").write(&mut text);
    fs::remove_file(&structs).expect("the build folder is writable");
    String::from_utf8(text).expect("cbindgen writes UTF-8")
}

fn version_macro(header: &str, part: &str) -> String {
    let define = format!("#define PP_VERSION_{part} ");
    header
        .lines()
        .find_map(|line| line.strip_prefix(&define))
        .unwrap_or_else(|| panic!("the header has no line \"{define}...\""))
        .trim()
        .to_owned()
}

#[test]
fn committed_header_is_the_generated_one() {
    let new = generated();
    if env::var_os(WRITE).is_some() {
        fs::write(header_path(), &new).expect("the header is writable");
        return;
    }
    let changed = committed().lines().zip(new.lines()).position(|(old, new)| old != new);
    assert!(
        committed() == new,
        "include/potential_particles.h differs from src/capi, first after line {changed:?}. Write it anew with\n    {REMEDY}"
    );
}

/// Read from `src/capi` through cbindgen, so that it holds while the header is being rewritten, too.
#[test]
fn version_macros_are_those_of_the_package() {
    let header = generated();
    for (part, package) in [
        ("MAJOR", env!("CARGO_PKG_VERSION_MAJOR")),
        ("MINOR", env!("CARGO_PKG_VERSION_MINOR")),
        ("PATCH", env!("CARGO_PKG_VERSION_PATCH")),
    ] {
        assert_eq!(
            version_macro(&header, part),
            package,
            "PP_VERSION_{part} in src/capi/abi.rs must follow the version {} in Cargo.toml",
            env!("CARGO_PKG_VERSION"),
        );
    }
}

/// A C programmer reads the comments as they are.
#[test]
fn comments_are_plain_text() {
    let header = generated();
    let comments = || header.lines().filter(|line| line.trim_start().starts_with("//") || line.starts_with(" *"));
    for mark in ["`", "# Safety", "# Errors", "](", "**", "///"] {
        let lines: Vec<_> = comments().filter(|line| line.contains(mark)).collect();
        assert!(lines.is_empty(), "{mark:?} in\n{}", lines.join("\n"));
    }
    assert!(header.is_ascii(), "not all editors show more than ASCII");
    let wide: Vec<_> = comments().filter(|line| line.len() > 112).collect();
    assert!(wide.is_empty(), "wider than a page:\n{}", wide.join("\n"));
}
