/** Words of the server by which the page knows what a difference of two runs is of. */

export const CONTROLLER = "Controller";
export const CHANGES = "Changed while it was recorded";
export const CHANGES_OF_CONTROLLER = ["Law", "Lanes", "Gains", "Parameters of laws", "Observer"];
export const LOADS = "Loads";
