//! The long search: `cargo xtask adversary --minutes N [--seed S]`.
//!
//! Random attacks and climbs from the best of them, until the time is over. An attack that breaks a claim is printed and
//! stored, and the command fails.

use adversary::attack::{Attack, TARGETS};
use adversary::regressions;
use std::process::ExitCode;
use std::time::{Duration, Instant};

/// Random attacks before each climb, and the climb's steps.
const DRAWN: u64 = 20;
const STEPS: u32 = 200;

fn main() -> ExitCode {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let [minutes, seed] = arguments.as_slice() else {
        eprintln!("usage: adversary MINUTES SEED");
        return ExitCode::FAILURE;
    };
    let (Ok(minutes), Ok(mut seed)) = (minutes.parse::<f64>(), seed.parse::<u64>()) else {
        eprintln!("expected minutes and a seed, got {minutes} and {seed}");
        return ExitCode::FAILURE;
    };
    let began = Instant::now();
    let over = |began: Instant| began.elapsed().as_secs_f64() > 60.0 * minutes;
    let (mut attacks, mut broken, mut shown) = (0_u64, 0_u64, Instant::now());
    let mut nearest = [0.0_f64; TARGETS.len()];
    while !over(began) {
        for (target, nearest) in TARGETS.into_iter().zip(&mut nearest) {
            let best = (seed..seed + DRAWN)
                .map(|seed| Attack::new(target, seed))
                .max_by(|a, b| a.run().1.total_cmp(&b.run().1));
            let Some(best) = best else { continue };
            attacks += DRAWN;
            let _ = best.climbed(STEPS, |attack, outcome| {
                attacks += 1;
                *nearest = nearest.max(outcome.tank_in_roundings);
                if shown.elapsed() > Duration::from_secs(5) {
                    shown = Instant::now();
                    println!(
                        "{:6.1} min  seed {seed}  {attacks} attacks  {broken} broken  on {target:?}: −E ≤ {nearest:.3} roundings",
                        began.elapsed().as_secs_f64() / 60.0
                    );
                }
                if outcome.is_broken() {
                    broken += 1;
                    println!("BROKEN: {attack}\n{outcome:#?}\n{}", attack.describe());
                    match regressions::store(attack) {
                        Ok(path) => println!("stored in {}", path.display()),
                        Err(cause) => eprintln!("not stored: {cause}"),
                    }
                }
                !outcome.is_broken() && !over(began)
            });
        }
        seed += DRAWN;
    }
    println!("{attacks} attacks, {broken} broken, next seed {seed}");
    if broken == 0 {
        ExitCode::SUCCESS
    } else {
        ExitCode::FAILURE
    }
}
