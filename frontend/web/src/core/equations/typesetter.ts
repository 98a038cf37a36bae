/** The parts of KaTeX that formulas need. */
import "katex/dist/katex.min.css";

export { render } from "katex";
