import { h, render } from "preact";
import { pages } from "./pages";
import { Shell, show_theme } from "./shell";

show_theme();
render(<Shell pages={pages} />, document.getElementById("app")!);
