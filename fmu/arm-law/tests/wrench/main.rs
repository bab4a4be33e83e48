//! Conditioning of a force sensor: each step against closed forms, the whole against synthetic sensors.
#![allow(non_snake_case, reason = "the paper's symbols")]

mod chain;
mod deadband;
mod filter;
mod refusals;
mod residual;
mod short_way;
mod synthetic;
mod tare;
mod transport;
mod validity;
