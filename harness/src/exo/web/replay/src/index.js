// exoReplay: what a page calls.

export { mount } from "./mount.js";
export { live } from "./live.js";
