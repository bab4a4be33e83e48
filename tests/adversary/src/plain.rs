//! A second writing of the law for one axis, without commands, bounds and tuning, of which parts can be left out.
//!
//! It shares no code with the crate `admittance`. Complete, it is the law; with a part left out it shows what the part is
//! for: the adversary beats it.

use crate::subject::{Order, Seen, Setup, Subject};
use admittance::{Gains, ParameterError};
use nalgebra::Vector1;

/// Looks ahead no further than this tick: no share.
pub const NO_LOOK_AHEAD: u16 = 1;
/// Gives nothing up when a sample is settled.
pub const NO_SETTLING: u16 = 2;
/// Does not know that a force works one sample later.
pub const NO_RESERVE: u16 = 4;
/// Lets a force that will brake pay beforehand.
pub const BRAKING_PAYS: u16 = 8;
/// The nominal feels the y that was asked for, not the one that is delivered: the first wrong reading of
/// docs/specification.md section 1.
pub const FEELS_THE_DEMAND: u16 = 16;
/// The nominal's velocity is not set back while the coupling is at its limit: the second wrong reading of
/// docs/specification.md section 1.
pub const NO_RESET: u16 = 32;
/// The spring is not cut to what the limit allows.
pub const NO_SLIP: u16 = 64;
/// Explicit Euler in place of the midpoint rule.
pub const EULER: u16 = 128;
/// Neither looks ahead nor gives up: what the paper's idea amounts to without a budget.
pub const NO_BUDGET: u16 = NO_LOOK_AHEAD | NO_SETTLING;

/// The law with the parts `OFF` left out.
#[derive(Clone, Copy, Debug)]
pub struct Plain<const OFF: u16> {
    setup: Setup<1>,
    engaged: bool,
    q: f64,
    last_step: Option<f64>,
    q_n: f64,
    v_n: f64,
    filtered: f64,
    said: f64,
    acting: f64,
    supplied: f64,
    H: f64,
    G: f64,
    tank: f64,
}

impl<const OFF: u16> Plain<OFF> {
    fn without(part: u16) -> bool {
        OFF & part != 0
    }

    /// Most work of the force `f` in the n-th sample from now.
    fn most_work(&self, f: f64, n: f64) -> f64 {
        let (v_max, a_max) = (self.setup.reach.v_max.x, self.setup.reach.a_max.x);
        let T = self.setup.settings.T;
        let by_speed = f.abs() * v_max * T;
        self.last_step
            .filter(|_| f != 0.0)
            .map_or(by_speed, |last| {
                by_speed.min(f * last + n * f.abs() * a_max * T * T)
            })
    }

    /// One tick at `q` with the human's force `f_h` and a share of the force at most.
    pub fn step(&mut self, q: f64, f_h: f64, authority: f64) -> Seen<1> {
        let Gains {
            M_n,
            D_n,
            K,
            K_P,
            f_max,
        } = self.setup.gains[0];
        let settings = self.setup.settings;
        let (T, alpha) = (settings.T, settings.alpha);

        // The sample that ends: its motion, what it cost.
        let step = if self.engaged { q - self.q } else { 0.0 };
        if !self.engaged {
            (self.q_n, self.v_n) = (q, 0.0);
        }
        let weight = if settings.dq_cutoff > 0.0 {
            1.0 - (-core::f64::consts::TAU * settings.dq_cutoff * T).exp()
        } else {
            1.0
        };
        self.filtered += weight * (step / T - self.filtered);
        let dq = self.filtered;
        let mut e = self.q_n - q;
        let most = f_max / (K * K_P);
        if !Self::without(NO_SLIP) {
            e = e.clamp(-most, most);
        }
        let kinetic = |v: f64| 0.5 * K * M_n / alpha * v * v;
        let spring = |e: f64| 0.5 * K * K_P * e * e;
        let paid = self.acting * step - self.supplied - self.H;
        if !Self::without(NO_SETTLING) {
            let left = (self.tank - paid - kinetic(self.v_n)).max(0.0);
            if spring(e) > left {
                e *= (left / spring(e)).sqrt();
            }
            let left = (self.tank - paid - spring(e)).max(0.0);
            if kinetic(self.v_n) > left {
                self.v_n *= (left / kinetic(self.v_n)).sqrt();
            }
        }
        self.H = kinetic(self.v_n) + spring(e);
        let created = self.H + paid;
        self.G += created;
        self.last_step = self.engaged.then_some(step);
        let reserved = if settings.delayed && !Self::without(NO_RESERVE) {
            self.most_work(self.said, 1.0)
        } else {
            0.0
        };
        self.tank = (self.tank - created).min(settings.E_0.max(reserved));
        (self.engaged, self.q) = (true, q);

        // The sample that begins.
        let v_n = self.v_n;
        let c = if Self::without(EULER) { 0.0 } else { 1.0 };
        let d = alpha * (1.0 + K_P * T / 2.0) * c;
        let mut v_m =
            (2.0 * M_n * v_n / T + f_h + d * dq - alpha * K_P * e) / (2.0 * M_n / T + D_n + d);
        let mut y = (v_m - dq) * (1.0 + K_P * T / 2.0) + K_P * e;
        let mut v_next = 2.0 * v_m - v_n;
        if Self::without(EULER) {
            (v_m, y) = (v_n, v_n - dq + K_P * e);
            v_next = v_n + T / M_n * (f_h - D_n * v_n - alpha * y);
        }
        let asked = K * y.clamp(-f_max / K, f_max / K) * authority;
        let driven = |f: f64| {
            if f == K * y || Self::without(FEELS_THE_DEMAND) || Self::without(EULER) {
                v_m
            } else {
                (2.0 * M_n * v_n / T + f_h - alpha * f / K) / (2.0 * M_n / T + D_n)
            }
        };
        let need = |f: f64| {
            let v_m = driven(f);
            let taken = f * v_m * T + K / alpha * D_n * v_m * v_m * T + spring(e);
            let work = if settings.delayed && !Self::without(NO_RESERVE) {
                let work = self.most_work(f, 2.0);
                if Self::without(BRAKING_PAYS) {
                    work
                } else {
                    work.max(0.0)
                }
            } else {
                self.most_work(f, 1.0)
            };
            reserved + work - taken
        };
        let mut share = 1.0;
        if !Self::without(NO_LOOK_AHEAD) && need(asked) > self.tank {
            let mut too_much = 1.0;
            share = 0.0;
            for _ in 0..53 {
                let between = 0.5 * (share + too_much);
                if need(asked * between) <= self.tank {
                    share = between;
                } else {
                    too_much = between;
                }
            }
        }
        let f = asked * share;
        let limited = f != K * y;
        if limited && !Self::without(EULER) && !Self::without(FEELS_THE_DEMAND) {
            v_m = driven(f);
            v_next = 2.0 * v_m - v_n;
            let v_b = (f / K - K_P * e) / (1.0 + K_P * T / 2.0) + dq;
            if !Self::without(NO_RESET) && v_b * v_b <= v_next * v_next {
                v_next = v_b;
            }
        }
        let felt = if Self::without(FEELS_THE_DEMAND) {
            K * y
        } else {
            f
        };
        let seen = Seen {
            tau: Vector1::new(f),
            felt: Vector1::new(felt),
            q_n: Vector1::new(q + e),
            dq_n: Vector1::new(v_n),
            e_nr: Vector1::new(e),
            tank: self.tank,
            G: self.G,
            H: self.H,
            share,
            debt: false,
            outside: false,
        };
        self.supplied = K / alpha * f_h * v_m * T;
        (self.q_n, self.v_n) = (q + e + T * v_m, v_next);
        self.acting = if settings.delayed { self.said } else { f };
        self.said = f;
        seen
    }
}

impl<const OFF: u16> Subject<1> for Plain<OFF> {
    fn build(setup: &Setup<1>) -> Result<Self, ParameterError> {
        Ok(Self {
            setup: *setup,
            engaged: false,
            q: 0.0,
            last_step: None,
            q_n: 0.0,
            v_n: 0.0,
            filtered: 0.0,
            said: 0.0,
            acting: 0.0,
            supplied: 0.0,
            H: 0.0,
            G: 0.0,
            tank: setup.settings.E_0,
        })
    }

    fn home() -> Vector1<f64> {
        Vector1::zeros()
    }

    /// Resting is no part of it: it is as if nothing were asked for.
    fn tick(&mut self, q: &Vector1<f64>, f_h: &Vector1<f64>, order: &Order<1>) -> Seen<1> {
        let authority = match order {
            Order::Rest => 0.0,
            Order::Run(request) => request.authority(),
        };
        self.step(q.x, f_h.x, authority)
    }

    fn acts(&mut self, _: &Vector1<f64>) {}

    fn tune(&mut self, _gains: [Gains; 1]) -> Result<(), ParameterError> {
        Ok(())
    }

    /// Euler's v_m is not that of the audit.
    fn shows_what_is_felt(_setup: &Setup<1>) -> bool {
        !Self::without(EULER)
    }
}
