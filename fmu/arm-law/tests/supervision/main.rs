//! Supervision: its table over every state and every combination of conditions, its memory by stories and random walks,
//! its drawing.

mod drawing;
mod parameters;
mod stories;
mod svg;
mod table;
mod walk;
