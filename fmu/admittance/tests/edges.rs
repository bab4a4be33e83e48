//! Edges: the nearest velocity by the energy's own measure, against closed forms and a search, and the energy that an edge
//! brings, which is never positive.
#![allow(non_snake_case, reason = "the paper's symbols")]

use admittance::bounds::{Bounds, Interval};
use admittance::edges::{Edge, keeps, kept};
use nalgebra::Vector3;

/// xorshift, in [−1, 1].
struct Random(u64);

impl Random {
    fn next(&mut self) -> f64 {
        self.0 ^= self.0 << 13;
        self.0 ^= self.0 >> 7;
        self.0 ^= self.0 << 17;
        (self.0 >> 11) as f64 / (1_u64 << 52) as f64 - 1.0
    }

    fn vector(&mut self) -> Vector3<f64> {
        Vector3::new(self.next(), self.next(), self.next())
    }

    /// Three decades.
    fn positive(&mut self) -> f64 {
        10_f64.powf(1.5 * self.next())
    }
}

const FREE: [Interval; 3] = [WIDE; 3];
/// Wide enough to be none.
const WIDE: Interval = Interval::ALL;

/// What the stops bring: Σ W (v − free) v.
fn brought(W: &Vector3<f64>, free: &Vector3<f64>, v: &Vector3<f64>) -> f64 {
    W.component_mul(&(v - free)).dot(v)
}

#[test]
fn one_edge_holds_back_along_itself_alone_by_the_closed_form() {
    let mut random = Random(1);
    let mut held = 0;
    for _ in 0..1000 {
        let (n, free) = (random.vector(), random.vector());
        let W = Vector3::from_fn(|_, _| random.positive());
        let c = random.next().max(0.0);
        let v = kept(&[Edge { n, c }], &FREE, &W, &free);
        let along = n.component_div(&W);
        let excess = (n.dot(&free) - c).max(0.0);
        let expected = free - along * (excess / n.dot(&along));
        assert!((v - expected).amax() < 1e-12, "{v} {expected}"); // rounding of numbers of about 1
        held += u32::from(excess > 0.0);
    }
    assert!(held > 200, "{held} of 1000 were held");
}

#[test]
fn a_velocity_within_all_edges_is_left_as_it_is_to_the_bit() {
    let edges = [
        Edge {
            n: Vector3::x(),
            c: 1.0,
        },
        Edge {
            n: Vector3::zeros(),
            c: 0.0,
        },
    ];
    let free = Vector3::new(0.1 + 0.2, -7.0, 3.0);
    assert_eq!(
        kept(&edges, &FREE, &Vector3::new(1.0, 2.0, 3.0), &free),
        free
    );
}

/// Against a search that knows nothing of multipliers: no random velocity within the edges is nearer.
#[test]
fn of_all_velocities_within_three_edges_it_is_the_nearest_by_the_weight() {
    let mut random = Random(2);
    let mut poor = 0;
    for _ in 0..300 {
        let mut worst = 1.0_f64;
        let edges: [Edge<3>; 3] = core::array::from_fn(|_| Edge {
            n: random.vector(),
            c: random.next().max(0.0),
        });
        let W = Vector3::from_fn(|_, _| random.positive());
        let free = random.vector() * 2.0;
        let distance = |v: &Vector3<f64>| W.dot(&(v - free).map(|x| x * x));
        let v = kept(&edges, &FREE, &W, &free);
        for _ in 0..2000 {
            let near = v + random.vector() * 10_f64.powf(2.0 * random.next() - 2.0);
            if keeps(&edges, &near) {
                worst = worst.min(distance(&near) / distance(&v));
            }
        }
        assert!(worst > 0.99, "{worst}");
        poor += u32::from(worst < 0.9999);
    }
    // Where two edges meet at a sharp angle, as W measures it, the rounds come to an end before the search.
    assert!(poor < 10, "{poor} of 300");
}

#[test]
fn edges_and_intervals_together_never_bring_energy() {
    let mut random = Random(3);
    let (mut held, mut worst) = (0, 0.0_f64);
    for _ in 0..20_000 {
        let edges: [Edge<3>; 7] = core::array::from_fn(|_| Edge {
            n: random.vector() * random.positive(),
            c: random.next().max(0.0),
        });
        let intervals = core::array::from_fn(|_| {
            let bounds = Bounds {
                speed: random.positive(),
                ..Bounds::default()
            };
            bounds.interval(0.0, 1.0, random.next() > 0.9)
        });
        let W = Vector3::from_fn(|_, _| random.positive().powi(3));
        let free = random.vector() * random.positive();
        let v = kept(&edges, &intervals, &W, &free);
        let size = W.dot(&v.map(|x| x * x)) + W.dot(&free.component_mul(&v).map(f64::abs));
        worst = worst.max(brought(&W, &free, &v) / (size + f64::MIN_POSITIVE));
        for (v, interval) in v.iter().zip(&intervals) {
            assert_eq!(interval.keep(*v), *v, "intervals are kept exactly");
        }
        held += u32::from(v != free);
    }
    assert!(worst < 1e-15, "{worst}"); // four roundings
    assert!(held > 15_000, "{held} of 20000 were held");
}

/// The negative control: the nearest point by the nominals' inertia alone, without the gains, brings energy.
#[test]
fn a_weight_without_the_gains_brings_energy() {
    let mut random = Random(4);
    let bringing = (0..1000).filter(|_| {
        let edge = Edge {
            n: random.vector(),
            c: 0.0,
        };
        let K = Vector3::from_fn(|_, _| random.positive());
        let free = random.vector();
        let v = kept(&[edge], &FREE, &Vector3::repeat(1.0), &free);
        brought(&K, &free, &v) > 1e-3
    });
    assert!(bringing.count() > 100);
}
