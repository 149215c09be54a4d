//! One pair again, with everything that is known about it.

use kit::stress::cases::{Case, Shapes, stream};
use kit::stress::judge::{FULL, Shared, Trial, bodies};
use kit::stress::pairs;
use kit::stress::reference::{Wanted, optimum};
use potential_particles::detect;
use std::process::ExitCode;

pub fn one(seed: u64, index: u64) -> ExitCode {
    let shapes = Shapes::of(seed, index);
    let case = Case::of(&shapes, seed, index);
    let shared = Shared::of(&shapes.a, &shapes.b, &mut stream(seed, 3, shapes.group));
    println!("seed {seed}, index {index}, {}", case.family());
    match detect(&shapes.a, &case.at_a.pose(), &shapes.b, &case.at_b.pose(), &FULL, None) {
        Ok(contact) => {
            println!("{contact:#?}");
            let [a, b] = bodies(&case);
            let lambda = contact.weight / (1.0 - contact.weight);
            if let Some(truth) = optimum(&a, &b, Wanted::Midway, &contact.branch_b, lambda) {
                let off = (truth.x.f64() - contact.branch_b).norm();
                println!(
                    "in 32 digits: s in [{:e}, {:e}], point {off:e} away, λ = {:e}",
                    truth.least,
                    truth.most,
                    truth.lambda.f64()
                );
                println!(
                    "point known to {:e}, S_A = {:e}, S_B = {:e}",
                    truth.doubt,
                    truth.a.value.f64(),
                    truth.b.value.f64()
                );
            }
        }
        Err(error) => println!("{error}"),
    }
    let verdict = pairs::one(&shapes, &shared, seed, index, Trial::WHOLE);
    println!("{:#?}\ndoubts without the second solver: {:?}", verdict.measures, verdict.doubts);
    for (fault, detail) in &verdict.faults {
        println!("{fault:?}: {detail}");
    }
    match serde_json::to_string(&case.line(format!("seed {seed} index {index}"))) {
        Ok(line) => println!("{line}"),
        Err(error) => eprintln!("stress: {error}"),
    }
    if verdict.faults.is_empty() { ExitCode::SUCCESS } else { ExitCode::FAILURE }
}
