import { Component, h } from "preact";
import { Page, PageProps } from "../page";

class Modules extends Component<PageProps, {}> {
  render() {
    return <h1>Modules</h1>;
  }
}

export const modules: Page = { pattern: ":c/modules", title: () => "Modules", view: Modules,
  nav: { label: "Modules", letter: "u", path: ({ c }) => [c, "modules"] } };
