import { Component, h } from "preact";
import { Page, PageProps } from "../page";

class Race extends Component<PageProps, {}> {
  render() {
    return <h1>Race</h1>;
  }
}

export const race: Page = { pattern: ":c/:d/race/:iteration?", title: ({ d, iteration }) => `${d}, race ${iteration ?? ""}`, view: Race,
  nav: { label: "Race", letter: "r", path: ({ c, d }) => d ? [c, d, "race"] : null } };
