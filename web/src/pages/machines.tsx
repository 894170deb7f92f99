// The winners of all designs, as pictures.

import { Component, h } from "preact";
import { Choice, Empty, Panel } from "../components";
import { Figure } from "../figure";
import { number, words } from "../format";
import { Page, PageProps } from "../page";
import { href, set_query } from "../route";
import { Design } from "../types";

const kFirst = 24;

class Machines extends Component<PageProps, {}> {
  render() {
    const { params: { c }, query, live } = this.props;
    const designs = live.campaigns.find((one) => one.c === c)?.designs ?? [];
    const shown = designs.filter((one) => (!query.mission || one.mission === query.mission) && (!query.method || one.method === query.method));
    const drawn = shown.filter((one) => one.best !== null);
    const most = query.all ? drawn.length : kFirst;
    return <div>
      <h1>Control software <span class="sub">of the best candidate of each design</span></h1>
      {designs.length > 1 && <div class="tools">
        {this.choice("Mission", "mission", designs.map((one) => one.mission))}
        {this.choice("Method", "method", designs.map((one) => one.method))}
        <span class="faint" role="status">{drawn.length} of {designs.length} designs</span>
      </div>}
      {drawn.length === 0 && <Empty>{shown.length > 0 ? "No design has a best candidate yet: it comes with the first iteration's end." : "No design is of this mission and method."}</Empty>}
      <div class="columns">{drawn.slice(0, most).map((one) => this.card(one))}</div>
      {drawn.length > most && <div class="tools"><button onClick={() => set_query({ all: 1 })}>Show all {drawn.length}</button></div>}
    </div>;
  }

  private choice(label: string, name: string, all: string[]) {
    const values = [...new Set(all)];
    if (values.length < 2) return null;
    return <Choice label={label} name={name} value={this.props.query[name] ?? ""} options={[["all", ""], ...values.map((value): [string, string] => [words(value), value])]} />;
  }

  private card(design: Design) {
    const { c } = this.props.params;
    return <Panel title={`${design.id}: ${words(design.mission)}, ${design.method}, ${design.repetition}`}>
      <p><a href={href([c, design.best!])}>{design.best}</a> <span class="faint">mean {number(design.best_mean)} in its races (higher is better), {design.state}</span></p>
      <Figure c={c} kind="machine" options={{ candidate: design.best }} version={design.best!} name={`control software of ${design.best}`}
        missing={(error) => <Empty>{error.message}</Empty>} />
    </Panel>;
  }
}

export const machines: Page = { pattern: ":c/machines", title: () => "control software", view: Machines,
  nav: { label: "Machines", letter: "m", path: ({ c }) => [c, "machines"] } };
