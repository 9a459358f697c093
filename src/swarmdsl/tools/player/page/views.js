// All views. A new one is a module with an exported `view` and a line here.
import { view as compare } from "./compare.js";
import { view as coverage } from "./coverage.js";
import { view as lanes } from "./lanes.js";
import { view as log } from "./log.js";
import { view as machine } from "./machine.js";
import { view as map } from "./map.js";
import { view as measures } from "./measures.js";
import { view as properties } from "./properties.js";
import { view as sequence } from "./sequence.js";
import { view as text } from "./text.js";
import { view as variables } from "./variables.js";
import { view as whatIf } from "./what_if.js";

/** The view above all others. */
export const MAIN = lanes;
/** The views below it, in the order of their tabs. */
export const VIEWS = [compare, machine, sequence, map, properties, variables, measures, coverage, log, text, whatIf];
/** What is called with the player when a page begins. */
export const BEGINNINGS = [];
