// All views. A new one is a module with an exported `view` and a line here.
import { view as lanes } from "./lanes.js";

/** The view above all others. */
export const MAIN = lanes;
/** The views below it, in the order of their tabs. */
export const VIEWS = [];
