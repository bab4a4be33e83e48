//! The limits of the workspace as edges: against J, and nowhere where they are said to be far.
#![allow(non_snake_case, reason = "the paper's symbols")]

use arm_law::kinematics::Kinematics;
use arm_law::workspace::Workspace;
use arm_law::workspace::edges::Limits;
use nalgebra::Vector3;

const T: f64 = 0.001;

/// Joint angles (rad) all over the exoskeleton arm's range and a little beyond, by a lattice of irrational steps.
fn poses() -> impl Iterator<Item = Vector3<f64>> {
    let part = |k: u32, step: f64| (f64::from(k) * step).fract();
    (0..20_000).map(move |k| {
        Vector3::new(
            -1.3 + 2.6 * part(k, 0.618_034),
            -2.1 + 3.2 * part(k, 0.754_878),
            0.05 + 2.6 * part(k, 0.569_840),
        )
    })
}

/// Speeds (rad/s) up to those at which a limit is near everywhere, and beyond.
fn speeds() -> impl Iterator<Item = Vector3<f64>> {
    poses().map(|q| (q * 1e4).map(|x| 1.2 * (2.0 * x.abs().fract() - 1.0)))
}

fn limits(kinematics: Kinematics) -> Limits {
    Limits::new(Workspace::default(), kinematics, T)
}

/// n·J dq is dq of one joint times its scale, and c the distance that is left times the same scale, over the time.
#[test]
fn each_edge_bounds_one_joint_by_the_distance_that_is_left() {
    let kinematics = Kinematics {
        handle_z: 0.07, // not the start value, which hides half of the formulas
        ..Kinematics::default()
    };
    let limits = limits(kinematics);
    let Workspace {
        q_min,
        q_max,
        radius_min,
        slowing_time,
        ..
    } = Workspace::default();
    for q in poses() {
        let pose = kinematics.at(&q);
        let edges = limits.at(&q, &pose).edges(&Vector3::zeros());
        for (j, edge) in edges[..6].iter().enumerate() {
            let i = j / 2;
            let along = pose.J.tr_mul(&edge.n);
            let scale = along[i].abs();
            let mut others = along;
            others[i] = 0.0;
            assert!(others.amax() < 1e-15, "{q} {j}: {along}"); // rounding of products below 1
            let left = [q_max[i] - q[i], q[i] - q_min[i]][j % 2];
            assert!((edge.c - left.max(0.0) * scale / slowing_time).abs() < 1e-14);
            assert_eq!(along[i] > 0.0, j % 2 == 0, "{q} {j}: upper, then lower");
        }
        let (away, radius) = (edges[6].n, pose.p.xy().norm());
        let radius = radius.copysign(pose.p.x * q[0].cos() + pose.p.y * q[0].sin());
        assert!((away.dot(&pose.p) + radius).abs() < 1e-14);
        assert!((edges[6].c - (radius - radius_min).max(0.0) / slowing_time).abs() < 1e-13);
    }
}

/// What makes it cheap must not make it blind: where no limit is near, a nominal that goes along with its robot keeps to all
/// edges anyway, at any speed.
#[test]
fn where_the_limits_are_far_no_edge_acts() {
    let (kinematics, limits) = (Kinematics::default(), limits(Kinematics::default()));
    let mut far = 0;
    for (q, dq) in poses().zip(speeds()) {
        let pose = kinematics.at(&q);
        if !limits.are_far(&q, Some(&(dq * T)), &pose) {
            continue;
        }
        far += 1;
        for edge in limits.at(&q, &pose).edges(&Vector3::zeros()) {
            assert!(edge.n.dot(&(pose.J * dq)) < edge.c, "{q} {dq}");
        }
    }
    assert!(far > 300, "{far} far");
}

#[test]
fn the_start_pose_is_far_from_every_limit() {
    let q = Vector3::new(0.0, -1.480_96, 1.701_38);
    let kinematics = Kinematics::default();
    let still = Vector3::zeros();
    assert!(limits(kinematics).are_far(&q, Some(&still), &kinematics.at(&q)));
    assert!(
        !limits(kinematics).are_far(&q, None, &kinematics.at(&q)),
        "nobody knows"
    );
}

/// From wherever angles are counted, in single precision from where the law engaged, the limits stay where they are.
#[test]
fn limits_do_not_move_with_the_place_that_angles_are_counted_from() {
    let kinematics = Kinematics::default();
    let limits = limits(kinematics);
    let q_0 = Vector3::new(0.3, -1.2, 1.4);
    let counted = limits.counted_from(&q_0);
    for q in poses().take(1000) {
        let pose = kinematics.at(&q);
        let (a, b) = (limits.at(&q, &pose), counted.at(&(q - q_0), &pose));
        let zero = Vector3::zeros();
        for (a, b) in a.edges(&zero).iter().zip(b.edges(&zero)) {
            assert!((a.n - b.n).amax() == 0.0 && (a.c - b.c).abs() < 1e-14);
        }
        let motion = Some(&zero);
        assert_eq!(
            limits.are_far(&q, motion, &pose),
            counted.are_far(&(q - q_0), motion, &pose)
        );
    }
}
