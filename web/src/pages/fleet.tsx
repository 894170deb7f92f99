import { Component, h } from "preact";
import { Page, PageProps } from "../page";

class Fleet extends Component<PageProps, {}> {
  render() {
    return <h1>Fleet</h1>;
  }
}

export const fleet: Page = { pattern: "fleet", title: () => "Fleet", view: Fleet,
  nav: { label: "Fleet", letter: "f", path: () => ["fleet"] } };
