import { Component, h } from "preact";
import { Page, PageProps } from "../page";

class Data extends Component<PageProps, {}> {
  render() {
    return <h1>Data</h1>;
  }
}

export const data: Page = { pattern: ":c/sql", title: () => "Data", view: Data,
  nav: { label: "Data", letter: "s", path: ({ c }) => [c, "sql"] } };
