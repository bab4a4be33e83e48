// The forces that are drawn: which, in which colour, and how long an arrow is for a newton.

import { nice } from "./format.js";

/** Of the arm, by class; `of` says which columns the scale comes from. */
export const FORCES = {
  hand: { name: "hand on the handle", short: "hand", of: ["f_h"] },
  contact: { name: "table or wall on the pad", short: "contact", of: ["f_e"] },
  payload: { name: "payload on the pad", short: "payload", of: ["tension"] },
  unseen: { name: "unseen force on the pad", short: "unseen", of: ["f_d"] },
};
/** An arrow of this length (m) stands for the force of its scale. */
export const LENGTH = 0.2;
/** Farther from the hand the nominal hand is no longer drawn in its place (m). */
export const FARTHEST = 0.45;

/** Forces (N) that an arrow of LENGTH stands for, from the largest ones that come. */
export const scalesOf = (largest) => Object.fromEntries(Object.entries(largest).map(([name, most]) => [name, nice(most)]));

/** A vector of an arrow, cut off where it would leave the picture. */
export function clipped(vector) {
  const length = Math.hypot(...vector);
  const most = 1.6 * LENGTH;
  return length > most ? vector.map((value) => (value * most) / length) : vector;
}

/** The forces of one arm: name, from which of its points, and the vector (N). */
export function forcesOf(arm) {
  return [
    ["hand", "handle", arm.f_h ?? [0, 0, 0]],
    ["contact", "pad", arm.f_e ?? [0, 0, 0]],
    ["payload", "pad", [0, 0, -Math.max(0, arm.tension ?? 0)]],
    ["unseen", "pad", arm.f_d ?? [0, 0, 0]],
  ];
}

/** Where an arrow of this vector begins at the handle: a hand that presses down is seen above it, not within the arm. */
export function tailAt(hand, vector) {
  return vector[2] < -0.5 * Math.hypot(...vector) ? hand.map((value, k) => value - vector[k]) : hand;
}

/** Where the nominal hand is drawn: its place, or as far towards it as fits; and its distance from the hand (m). */
export function nominalHand(hand, p_n) {
  const away = p_n.map((value, k) => value - hand[k]);
  const distance = Math.hypot(...away);
  const share = distance > FARTHEST ? FARTHEST / distance : 1;
  return { at: hand.map((value, k) => value + share * away[k]), distance, outside: share < 1 };
}
