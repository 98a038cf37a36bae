/** Of KaTeX, what formulas need. */
import "katex/dist/katex.min.css";

export { render } from "katex";
