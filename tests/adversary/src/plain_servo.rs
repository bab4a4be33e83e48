//! The servo form of one axis, written a second time from its page and docs/passivity.md, with parts to leave out: negative
//! controls. No bounds, no hold, no damping on top.

use crate::servo::{Commands, Told};
use crate::subject::{Order, Seen, Setup};
use admittance::{Gains, ParameterError};
use nalgebra::Vector1;

/// Left out: the spring is not given up for what a sample has cost.
pub const NO_SETTLING: u8 = 1;
/// Left out: in debt the drive is told the same as ever.
pub const NO_STANDSTILL: u8 = 2;
/// Left out: in debt the nominal feels what was measured.
pub const FEELS_IN_DEBT: u8 = 4;

/// The law without the parts `WITHOUT`.
#[derive(Clone, Copy, Debug)]
pub struct PlainServo<const WITHOUT: u8> {
    T: f64,
    alpha: f64,
    E_0: f64,
    gains: Gains,
    /// where the robot was, and what is stored and was brought there
    last: Option<Last>,
    tank: f64,
    G: f64,
}

#[derive(Clone, Copy, Debug)]
struct Last {
    q: f64,
    q_n: f64,
    v_n: f64,
    H: f64,
    supplied: f64,
    engaged: bool,
}

impl<const WITHOUT: u8> PlainServo<WITHOUT> {
    fn energy(&self, e: f64, v_n: f64) -> [f64; 2] {
        let Gains { M_n, K, K_P, .. } = self.gains;
        [
            0.5 * K * K_P * e * e,
            0.5 * K * M_n * v_n * v_n / self.alpha,
        ]
    }
}

impl<const WITHOUT: u8> Commands<1> for PlainServo<WITHOUT> {
    fn build(setup: &Setup<1>) -> Result<Self, ParameterError> {
        let settings = &setup.settings;
        Ok(Self {
            T: settings.T,
            alpha: settings.alpha,
            E_0: settings.E_0,
            gains: setup.gains[0],
            last: None,
            tank: settings.E_0,
            G: 0.0,
        })
    }

    fn tick(
        &mut self,
        q: &Vector1<f64>,
        f_h: &Vector1<f64>,
        tau_m: &Vector1<f64>,
        order: &Order<1>,
    ) -> (Told<1>, Seen<1>) {
        let (q, f_h, tau_m) = (q.x, f_h.x, tau_m.x);
        let Gains {
            M_n,
            D_n,
            K,
            K_P,
            f_max,
        } = self.gains;
        let (T, e_max) = (self.T, f_max / (K * K_P));
        let runs = matches!(order, Order::Run(_));
        let engaged = runs && self.last.is_some_and(|last| last.engaged);

        // What the sample cost, and what is given up for it: the spring first.
        let (mut e, mut v_n) = match &self.last {
            Some(last) if engaged => ((last.q_n - q).clamp(-e_max, e_max), last.v_n),
            _ => (0.0, 0.0),
        };
        let cost = self
            .last
            .map_or(0.0, |last| tau_m * (q - last.q) - last.H - last.supplied);
        let [spring, mass] = self.energy(e, v_n);
        if WITHOUT & NO_SETTLING == 0 && cost + spring + mass > self.tank {
            let left = self.tank - cost;
            e *= ((left - mass).max(0.0) / spring.max(f64::MIN_POSITIVE))
                .sqrt()
                .min(1.0);
            v_n *= (left.max(0.0) / mass.max(f64::MIN_POSITIVE))
                .sqrt()
                .min(1.0);
        }
        let H: f64 = self.energy(e, v_n).iter().sum();
        self.G += H + cost;
        self.tank = (self.tank - H - cost).min(self.E_0);
        let debt = self.tank < -1e-12 * (self.E_0 + cost.abs() + H);

        // The nominal moves on.
        let feels = engaged && (!debt || WITHOUT & FEELS_IN_DEBT != 0);
        let felt = if feels { tau_m } else { 0.0 };
        let dq = self
            .last
            .filter(|_| engaged)
            .map_or(0.0, |last| (q - last.q) / T);
        let v_m = (2.0 * M_n * v_n / T + f_h - self.alpha * felt / K) / (2.0 * M_n / T + D_n);
        let mut v_next = 2.0 * v_m - v_n;
        let ahead = (felt.clamp(-f_max, f_max) / K - K_P * e) / (1.0 + K_P * T / 2.0);
        let v_b = dq + if felt * ahead > 0.0 { ahead } else { 0.0 };
        let limited = felt.abs() >= f_max || e.abs() >= e_max;
        if limited && felt.signum() * (v_next - v_b) > 0.0 && v_b * v_b <= v_next * v_next {
            v_next = v_b;
        }
        let stands = !runs || debt && WITHOUT & NO_STANDSTILL == 0;
        let told = if stands {
            [q, 0.0]
        } else {
            [q + e + T * v_m / 2.0, v_m]
        };
        self.last = Some(Last {
            q,
            q_n: q + e + T * v_m,
            v_n: if runs { v_next } else { 0.0 },
            H,
            supplied: if runs {
                K / self.alpha * f_h * v_m * T
            } else {
                0.0
            },
            engaged: runs,
        });
        let seen = Seen {
            tau: Vector1::zeros(),
            felt: Vector1::new(felt),
            q_n: Vector1::new(q + e),
            dq_n: Vector1::new(v_n),
            e_nr: Vector1::new(e),
            tank: self.tank,
            G: self.G,
            H,
            share: 1.0,
            debt,
            outside: false,
        };
        (told.map(Vector1::new), seen)
    }

    fn tune(&mut self, gains: [Gains; 1]) -> Result<(), ParameterError> {
        self.gains = gains[0];
        Ok(())
    }
}
