/** How much of a session the page asks for and keeps. */

export const RATE_HZ = 200;
/** Sent at first; the server holds no more. */
export const HISTORY_S = 20;
export const LONGEST_WINDOW_S = 60;
