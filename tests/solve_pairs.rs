//! The example solve_pairs, run as a process.

use kit::truth;
use kit::truth::{number, vector};
use nalgebra::Vector3;
use potential_particles::{Settings, detect};
use serde_json::{Value, json};
use std::io::Write;
use std::path::{Path, PathBuf};
use std::process::{Command, Output, Stdio};

const TRUTH: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/tests/data/pairs.jsonl");

/// The example as "cargo test" builds it along with the tests; "cargo test --test solve_pairs" alone does not.
fn program() -> PathBuf {
    let test = std::env::current_exe().expect("a running test has a path");
    let profile = test.parent().and_then(Path::parent).expect("tests run from the deps folder of their profile");
    let program = profile.join("examples").join(format!("solve_pairs{}", std::env::consts::EXE_SUFFIX));
    assert!(program.exists(), "{} is missing: run all tests, or build it first with this profile", program.display());
    program
}

fn run(arguments: &[&str], input: &str) -> Output {
    let mut child = Command::new(program())
        .args(arguments)
        .stdin(Stdio::piped())
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .expect("the example starts");
    let mut stdin = child.stdin.take().expect("stdin is piped");
    let input = input.to_owned();
    let writer = std::thread::spawn(move || {
        // A program that stops early closes its end; what it says then is judged by the tests.
        let _ = stdin.write_all(input.as_bytes());
    });
    let output = child.wait_with_output().expect("the example ends");
    writer.join().expect("the input was handed over");
    output
}

fn answers(output: &Output) -> Vec<Value> {
    let text = std::str::from_utf8(&output.stdout).expect("text");
    text.lines().map(|line| serde_json::from_str(line).expect("one JSON object a line")).collect()
}

fn errors(output: &Output) -> &str {
    std::str::from_utf8(&output.stderr).expect("text")
}

fn coordinates(value: &Value) -> Vector3<f64> {
    let numbers: Vec<f64> = value.as_array().expect("a vector").iter().map(|v| v.as_f64().expect("a number")).collect();
    Vector3::from_column_slice(&numbers)
}

/// Two unit cubes, rounded by 0.1, the second 0.95 above the first and both moved by `shift`.
fn cubes(shift: [f64; 3]) -> Value {
    let normals = [[1, 0, 0], [-1, 0, 0], [0, 1, 0], [0, -1, 0], [0, 0, 1], [0, 0, -1]];
    let cube = json!({"n": normals, "d": vec![0.4; 6], "r": 0.1, "k": 0.01, "R": 0.9});
    let above = [shift[0] + 0.125, shift[1] - 0.0625, shift[2] + 0.9375];
    json!({
        "A": cube, "B": cube,
        "a": {"pos": shift, "q": [1, 0, 0, 0]},
        "b": {"pos": above, "q": [0.9, 0.1, 0.2, 0.3]},
    })
}

#[test]
fn answers_the_pairs_that_were_solved_to_40_digits() {
    let output = run(&[TRUTH], "");
    assert_eq!(errors(&output), "");
    assert!(output.status.success());
    let (answers, pairs) = (answers(&output), truth::pairs());
    assert_eq!(answers.len(), pairs.len());
    for (index, (answer, pair)) in answers.iter().zip(&pairs).enumerate() {
        let (midway, closest, truth) = (&answer["midway"], &answer["closest"], &pair.truth);
        assert_eq!(answer["line"], index + 1);
        let line = index + 1;
        let [a, b] = [&pair.shape_a, &pair.shape_b].map(|shape| shape.particle().bounding_radius());
        let small = a.min(b);
        let s = number(&truth.s4);
        let gap = midway["gap"].as_f64().expect("a gap");
        let found = midway["s"].as_f64().expect("s");
        assert!((found - s).abs() <= gap, "line {line}: s={found} is further than {gap} from {s}");
        if (s - 1.0).abs() > gap {
            let kind = if s < 1.0 { "overlapping" } else { "separated" };
            assert_eq!((&midway["kind"], &closest["kind"]), (&json!(kind), &json!(kind)), "line {line}");
        }
        let bound = midway["bound"].as_f64().expect("a bound");
        let distance = (coordinates(&midway["point"]) - vector(&truth.x4)).norm();
        assert!(distance <= bound, "line {line}: the point is {distance} off, the bound is {bound}");
        assert_eq!(closest["slack"], json!({"a": !truth.ok1, "b": !truth.ok2}), "line {line}");
        for (known, scale, point, s_truth, p_truth) in
            [(truth.ok2, "s_a", "p2", &truth.s_a, &truth.p2), (truth.ok1, "s_b", "p1", &truth.s_b, &truth.p1)]
        {
            if !known {
                assert!(closest[scale].is_null() && closest[point][0].is_null(), "line {line}: {closest}");
                continue;
            }
            let (s, p) = (number(s_truth.as_ref().expect("known")), vector(p_truth.as_ref().expect("known")));
            let (found, at) = (closest[scale].as_f64().expect("s"), coordinates(&closest[point]));
            let gap = closest["gap"].as_f64().expect("a gap");
            assert!((found - s).abs() <= gap, "line {line}: {scale}={found} is further than {gap} from {s}");
            // Of near-polyhedral pairs with r = 1e-8 nothing better is known; the others are far below.
            let off = (at - p).norm();
            assert!(off <= 1e-5 * small, "line {line}: {point} is {off} off");
        }
    }
}

#[test]
fn a_bad_line_is_named_and_the_rest_is_solved() {
    let good = cubes([0.0; 3]);
    let mut flat = good.clone();
    flat["B"]["r"] = json!(-0.1);
    let mut turned = good.clone();
    turned["a"]["q"] = json!([0, 0, 0, 0]);
    let mut uneven = good.clone();
    uneven["A"]["d"] = json!([0.4]);
    let mut placeless = good.clone();
    placeless.as_object_mut().expect("an object").remove("b");
    let broken = Value::String("{\"A\": {".into());
    let lines = [&broken, &good, &flat, &Value::Null, &turned, &uneven, &placeless, &good].map(|line| match line {
        Value::String(text) => text.clone(),
        Value::Null => String::new(),
        object => object.to_string(),
    });
    let output = run(&["-"], &lines.join("\n"));
    assert_eq!(output.status.code(), Some(1));
    let solved: Vec<Value> = answers(&output).iter().map(|answer| answer["line"].clone()).collect();
    assert_eq!(solved, [2, 8], "the blank line 4 counts, but is no pair");
    let said: Vec<&str> = errors(&output).lines().collect();
    assert_eq!(said.len(), 6, "{said:?}");
    for (text, line, reason) in [
        (said[0], "line 1: ", "EOF"),
        (said[1], "line 3: B: ", "r=-0.1"),
        (said[2], "line 5: a: ", "orientation"),
        (said[3], "line 6: A: ", "6 normals n, but 1 offsets d"),
        (said[4], "line 7: ", "missing field `b`"),
        (said[5], "5 bad lines", ""),
    ] {
        assert!(text.starts_with(line) && text.contains(reason), "'{text}' should be '{line}...{reason}'");
    }
}

#[test]
fn bytes_that_are_no_text_spoil_their_own_line_only() {
    let mut child = Command::new(program())
        .arg("-")
        .stdin(Stdio::piped())
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .expect("the example starts");
    let mut stdin = child.stdin.take().expect("stdin is piped");
    stdin.write_all(b"\xff\xfe\n").and_then(|()| writeln!(stdin, "{}", cubes([0.0; 3]))).expect("it reads all lines");
    drop(stdin);
    let output = child.wait_with_output().expect("the example ends");
    assert_eq!((output.status.code(), answers(&output).len()), (Some(1), 1));
    assert!(errors(&output).starts_with("line 1: "), "{}", errors(&output));
}

#[test]
fn a_file_that_is_not_there_is_named() {
    let output = run(&["no/such/pairs.jsonl"], "");
    assert_eq!(output.status.code(), Some(1));
    assert!(errors(&output).starts_with("no/such/pairs.jsonl: "), "{}", errors(&output));
    assert!(output.stdout.is_empty());
}

#[test]
fn the_command_line_explains_itself() {
    let output = run(&["--help"], "");
    assert!(output.status.success());
    let text = String::from_utf8_lossy(&output.stdout);
    assert!(["FILE.jsonl", "--formulation", "--back-end"].iter().all(|word| text.contains(word)), "{text}");
    assert_eq!(run(&[], "").status.code(), Some(2));
    assert_eq!(run(&["--formulation", "nearest", "-"], "").status.code(), Some(2));
}

#[test]
fn one_formulation_and_either_back_end() {
    let input = cubes([0.0; 3]).to_string();
    let both = &answers(&run(&["-"], &input))[0];
    let midway = &answers(&run(&["--formulation", "midway", "-"], &input))[0];
    assert_eq!(midway["midway"], both["midway"]);
    assert!(midway.get("closest").is_none());
    let closest = &answers(&run(&["--formulation", "closest", "-"], &input))[0];
    assert_eq!(closest["closest"], both["closest"]);
    assert!(closest.get("midway").is_none());
    let cone_program = &answers(&run(&["--back-end", "cone-program", "-"], &input))[0];
    assert_eq!(
        (&cone_program["midway"]["path"], &both["midway"]["path"]),
        (&json!("cone_program"), &json!("fast cold"))
    );
    for key in ["point", "point_on_a", "point_on_b", "normal"] {
        let distance = coordinates(&cone_program["midway"][key]) - coordinates(&both["midway"][key]);
        assert!(distance.norm() < 1e-5, "{key}: {distance}");
    }
}

#[test]
fn far_from_the_origin_nothing_is_lost() {
    let near = run(&["-"], &cubes([0.0; 3]).to_string());
    let answer = &answers(&near)[0];
    assert_eq!(answer["midway"]["kind"], "overlapping");
    let (on_a, on_b) = (coordinates(&answer["midway"]["point_on_a"]), coordinates(&answer["midway"]["point_on_b"]));
    let overlap = answer["midway"]["overlap"].as_f64().expect("an overlap");
    assert!(((on_a - on_b).norm() - overlap).abs() < 1e-15, "the surface points are an overlap apart");
    // A power of two beyond 1e7: the two positions themselves are exact.
    let shift = f64::from(1 << 24);
    let far = run(&["-"], &cubes([shift, -shift, shift]).to_string());
    assert_eq!(near.stdout, far.stdout, "not the same to the last digit");
}

/// Where the difference of the two positions is no double, the rest of it counts: s of sharp edges tells.
#[test]
fn no_digit_of_a_distance_is_lost() {
    let mut pair = cubes([0.0; 3]);
    for shape in ["A", "B"] {
        pair[shape]["r"] = json!(1e-9);
        pair[shape]["d"] = json!(vec![0.5; 6]);
    }
    // Face to face, 3 r apart.
    pair["b"]["q"] = json!([1, 0, 0, 0]);
    pair["a"]["pos"] = json!([0.3, 0.1, 0.2]);
    pair["b"]["pos"] = json!([1.300_000_003, 0.15, 0.25]);
    let rounded = {
        let mut moved = pair.clone();
        moved["a"]["pos"] = json!([0.3 - 1.300_000_003, 0.1 - 0.15, 0.2 - 0.25]);
        moved["b"]["pos"] = json!([0, 0, 0]);
        moved
    };
    let found = run(&["--gap-tolerance", "1e-14", "-"], &format!("{pair}\n{rounded}"));
    let [of_pair, of_rounded] = [0, 1].map(|i| answers(&found)[i]["midway"]["s"].as_f64().expect("s"));

    let read = |name: &str| serde_json::from_value::<truth::Shape>(pair[name].clone()).expect("a shape").particle();
    let place = |name: &str| serde_json::from_value::<truth::Place>(pair[name].clone()).expect("a place").pose();
    let settings = Settings::default().with_gap_tolerance(1e-14).with_solve_separated(true);
    let direct = detect(&read("A"), &place("a"), &read("B"), &place("b"), &settings, None).expect("an answer");
    assert!((of_pair - direct.s).abs() <= 1e-15 * direct.s, "{of_pair} and {}", direct.s);
    assert!((of_rounded - of_pair).abs() > 1e-10 * direct.s, "the pair does not tell: {of_rounded} and {of_pair}");
}

#[test]
fn numbers_have_17_digits_and_what_does_not_apply_is_null() {
    let mut apart = cubes([0.0; 3]);
    apart["a"]["pos"] = json!([0, 0, -3]);
    let output = run(&["-"], &apart.to_string());
    let answer = &answers(&output)[0];
    assert_eq!((&answer["midway"]["kind"], &answer["closest"]["kind"]), (&json!("separated"), &json!("separated")));
    // No overlap and no surface points; a closest point all the same.
    assert!(answer["midway"]["overlap"].is_null() && answer["midway"]["point_on_a"][0].is_null(), "{answer}");
    assert!(answer["closest"]["p1"][0].is_f64() && answer["closest"]["s_b"].as_f64() > Some(1.0), "{answer}");
    let text = String::from_utf8_lossy(&output.stdout);
    let s = text.split("\"s\":").nth(1).and_then(|rest| rest.split(',').next()).expect("s is written");
    let digits = s.split('e').next().expect("a mantissa").chars().filter(char::is_ascii_digit).count();
    assert_eq!(digits, 17, "{s}");
}
