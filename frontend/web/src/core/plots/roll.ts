/** A canvas as a roll, on which a plot moves while what was drawn stays where it is. */

/** Columns of the roll, from one up to before another; `shift` is from columns of the plot to them. */
export interface Piece {
  from: number;
  to: number;
  shift: number;
}

/**
 * Where the columns of a plot from `first` on are on a roll as wide as the plot, `start` being where
 * its column 0 is: up to the end of the roll, then on from its beginning.
 */
export function piecesOf(start: number, first: number, width: number): Piece[] {
  const pieces = [
    { from: start + first, to: width, shift: start },
    { from: Math.max(0, start + first - width), to: start, shift: start - width },
  ];
  return pieces.filter((piece) => piece.from < piece.to);
}
