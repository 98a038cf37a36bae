import "uplot/dist/uPlot.min.css";
import "./theme.css";
import "./layout/layout.css";
import "./layout/comparison.css";
import "./plots/plots.css";
import "./controls/controls.css";
import { render } from "preact";
import { openDebugDoor } from "./debug";
import { App } from "./layout/app";
import { startFrames } from "./plots/frame";
import { openStream, watchNetwork } from "./state/session";

render(<App />, document.getElementById("app") as HTMLElement);
openDebugDoor();
startFrames();
watchNetwork();
openStream();
