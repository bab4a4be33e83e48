//! The implicit velocity problem from random states: the equation holds, every force obeys its law, the direct method and
//! projected Gauss–Seidel agree.

#![allow(
    non_snake_case,
    reason = "the symbols of mechanics with their capitals: A, J"
)]

use mechanics::arm::gauss_seidel;
use mechanics::arm::guess::{Guess, Motion};
use mechanics::arm::problem::{Contact, FACINGS, Joint, Path, Problem, Solution};
use mechanics::arm::solver;
use mechanics::arm::state::Place;
use mechanics::arm::{Inputs, Parameters, State};
use nalgebra::Vector3;
use proptest::prelude::*;

fn vector(size: f64) -> impl Strategy<Value = Vector3<f64>> {
    [-size..size, -size..size, -size..size].prop_map(Vector3::from)
}

/// At rest, creeping or moving.
fn velocity() -> impl Strategy<Value = Vector3<f64>> {
    prop_oneof![Just(Vector3::zeros()), vector(1e-3), vector(3.0)]
}

fn motion() -> impl Strategy<Value = Motion> {
    prop_oneof![
        Just(Motion::Held),
        Just(Motion::Forward),
        Just(Motion::Backward),
        Just(Motion::High),
        Just(Motion::Low)
    ]
}

fn guess() -> impl Strategy<Value = Guess> {
    ([motion(), motion(), motion()], any::<[bool; 2]>())
        .prop_map(|(joint, pushes)| Guess { joint, pushes })
}

prop_compose! {
    /// An arm anywhere between its stops, near them or at them, table and wall within a millimetre of the pad or far, any force that
    /// drive, human and disturbance can exert, and more.
    fn problems()(
        part in [0.0..=1.0, 0.0..=1.0, 0.0..=1.0], ends in [0..6, 0..6, 0..6], dq in velocity(), attached in any::<bool>(),
        payload in 1.0..30.0, tau in vector(300.0), f_h in vector(100.0), f_d in vector(1000.0), dt in prop_oneof![Just(1e-4), 5e-6..1e-3],
        gap in [-1e-3..1e-3_f64, -1e-3..1e-3_f64], far in any::<[bool; 2]>(), squeeze in [0.0..2e-3, 0.0..2e-3],
        mu in [0.0..0.8, 0.0..0.8], loss in prop_oneof![Just(0.0), 0.0..0.5],
    ) -> Problem {
        let mut parameters = Parameters { payload_m: payload, ..Parameters::default() };
        let q = Vector3::from_fn(|i, _| {
            let stops = &parameters.stops[i];
            match ends[i] {
                0 => stops.min,
                1 => stops.max,
                2 => stops.min + 1e-4 * part[i],
                3 => stops.max - 1e-4 * part[i],
                _ => stops.min + (stops.max - stops.min) * part[i],
            }
        });
        let place = Place::at(&parameters, &q);
        if !far[0] { parameters.table.z = place.pad.p.z + gap[0]; }
        if !far[1] { parameters.wall.x = place.pad.p.x - gap[1]; }
        (parameters.table.mu, parameters.wall.mu) = (mu[0], mu[1]);
        for gear in &mut parameters.gear_loss { (gear.drive, gear.back) = (loss, 0.7 * loss); }
        let s = [gap[0].max(0.0) + squeeze[0], gap[1].max(0.0) + squeeze[1]];
        let state = State { q, dq, tau: Vector3::zeros(), s, attached };
        let body = mechanics::arm::rigid_body::RigidBody::at(
            &place.pose, &parameters.lengths, &parameters.masses, if attached { payload } else { 0.0 });
        let inputs = Inputs { f_h: f_h.into(), f_d: f_d.into(), ..Inputs::default() };
        mechanics::arm::substep::problem(&parameters, &state, &place, &body, &tau, &inputs, dt)
    }
}

/// How far `solution` is from solving `problem`, relative to the largest impulse.
fn violation(problem: &Problem, solution: &Solution) -> f64 {
    let Problem {
        A,
        b,
        joints,
        J,
        contacts,
    } = problem;
    let Solution {
        v,
        joint,
        normal,
        tangent,
        ..
    } = solution;
    let mut scale = b.amax();
    let mut on_pad = *tangent;
    for (k, facing) in FACINGS.iter().enumerate() {
        on_pad[facing.axis()] += facing.sign() * normal[k];
        scale = scale.max(normal[k]);
    }
    scale = scale.max(joint.amax());
    let mut worst = (A * v - b - joint - J.transpose() * on_pad).amax();

    for (i, Joint { against, low, high }) in joints.iter().enumerate() {
        // Beyond a stop; friction that does not oppose, or exceeds its limit; a stop that pulls.
        worst = worst.max(A[(i, i)] * (v[i] - high).max(low - v[i]));
        let rest = 1e-13 * scale / A[(i, i)]; // rounding
        let friction = if v[i] > rest {
            -against[0]
        } else if v[i] < -rest {
            against[1]
        } else {
            joint[i].clamp(-against[0], against[1])
        };
        let stop = joint[i] - friction;
        if v[i] < high - rest {
            worst = worst.max(-stop);
        }
        if v[i] > low + rest {
            worst = worst.max(stop);
        }
    }
    let w = J * v;
    let mut grip = [0.0; 2];
    for (k, Contact { push, kappa_dt, mu }) in contacts.iter().enumerate() {
        let facing = FACINGS[k];
        let law = (push - kappa_dt * facing.sign() * w[facing.axis()]).max(0.0);
        worst = worst.max((normal[k] - law).abs());
        grip[k] = mu * normal[k];
    }
    worst.max(friction_off(&w, tangent, &grip, scale)) / scale
}

/// How far `t` is from being the friction of both surfaces, each a disc of radius `grip` in its plane: −grip w/|w| of those on
/// which the pad slides, anything within the disc of those that hold it.
fn friction_off(w: &Vector3<f64>, t: &Vector3<f64>, grip: &[f64; 2], scale: f64) -> f64 {
    // What counts as motion: 5e-14 m/s per N·m·s of impulse, 1e-14 over a mobility of 0.3. A velocity is that uncertain.
    let rounding = 5e-14 * scale;
    let mut rest = *t;
    let mut holds = [0.0; 2];
    let mut uncertain = 0.0_f64;
    for (k, [i, j]) in [[0, 1], [1, 2]].into_iter().enumerate() {
        let speed = w[i].hypot(w[j]);
        if speed > rounding {
            rest[i] += grip[k] * w[i] / speed;
            rest[j] += grip[k] * w[j] / speed;
            uncertain += grip[k] * (rounding / speed).min(2.0);
        } else {
            holds[k] = grip[k];
        }
    }
    // What is left must be a vector of the table's disc and one of the wall's.
    let (x, z) = (rest.x.abs() - holds[0], rest.z.abs() - holds[1]);
    let left = |grip: f64, t: f64| (grip * grip - t * t).max(0.0).sqrt();
    let y = rest.y.abs() - left(holds[0], rest.x) - left(holds[1], rest.z);
    (x.max(y).max(z) - uncertain).max(0.0)
}

/// One surface holds the pad up to the disc's edge, whatever the direction: the measure of this file is no box.
#[test]
fn the_measure_of_this_file_tells_a_disc_from_a_box() {
    let off = |t: [f64; 3], w: [f64; 3]| friction_off(&w.into(), &t.into(), &[1.0, 0.0], 1.0);
    assert_eq!(off([0.6, 0.8, 0.0], [0.0; 3]), 0.0);
    assert!(off([1.0, 1.0, 0.0], [0.0; 3]) > 0.4);
    assert!(off([-0.6, -0.8, 0.0], [0.3, 0.4, 0.0]) < 1e-12);
    assert!(off([-1.0, 0.0, 0.0], [0.3, 0.4, 0.0]) > 0.4);
    assert!(off([-1.0, -1.0, 0.0], [0.3, 0.4, 0.0]) > 0.1);
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(10_000))]

    #[test]
    fn every_force_obeys_its_law_whatever_the_first_guess(problem in problems(), guess in guess()) {
        let mut guess = guess;
        let solution = solver::solve(&problem, &mut guess);
        // The solver's own measure of rounding is 1e-14; a multiplication by J or A may double it a few times.
        prop_assert!(violation(&problem, &solution) <= 1e-13, "{:e} {solution:?}", violation(&problem, &solution));
        // From the guess that it left, the solver finds the same at once.
        let again = solver::solve(&problem, &mut guess);
        prop_assert_eq!(again.path, Path::Guessed);
        prop_assert_eq!(again.v, solution.v);
    }

    #[test]
    fn gauss_seidel_finds_the_same_velocity(problem in problems(), guess in guess()) {
        let solution = solver::solve(&problem, &mut guess.clone());
        let swept = gauss_seidel::solve(&problem, 200_000);
        prop_assert!(violation(&problem, &swept) <= 1e-11);
        // 1e-11 of the impulse, over the smallest eigenvalue of A (2 kg·m²).
        let scale = problem.b.amax().max(1e-3);
        prop_assert!((swept.v - solution.v).amax() <= 1e-10 * scale, "{} {}", swept.v, solution.v);
    }
}
