import { Component, h } from "preact";
import { Page, PageProps } from "../page";

class Design extends Component<PageProps, {}> {
  render() {
    return <h1>Design</h1>;
  }
}

export const design: Page = { pattern: ":c/:d", title: ({ d }) => d, view: Design,
  nav: { label: "Design", letter: "d", path: ({ c, d }) => d ? [c, d] : null } };
