import { Component, h } from "preact";
import { Page, PageProps } from "../page";

class Campaigns extends Component<PageProps, {}> {
  render() {
    return <h1>Campaigns</h1>;
  }
}

export const campaigns: Page = { pattern: "", title: () => "Campaigns", view: Campaigns,
  nav: { label: "Campaigns", letter: "o", path: () => [] } };
