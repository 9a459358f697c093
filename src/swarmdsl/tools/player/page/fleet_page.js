// The page of a fleet: that of the player, with a view and buttons more.
import { operate, view } from "./fleet.js";
import { started } from "./main.js";
import { BEGINNINGS, VIEWS } from "./views.js";

// The page begins when its recording is unpacked, which is later than this.
VIEWS.unshift(view);
BEGINNINGS.push(operate);
export const begun = started;
