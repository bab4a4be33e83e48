//! Supervision: its table over every state and every combination of conditions, its memory by stories and random walks,
//! its drawing; its watch on a drift of the force.

mod drawing;
mod drift;
mod parameters;
mod stories;
mod svg;
mod table;
mod walk;
