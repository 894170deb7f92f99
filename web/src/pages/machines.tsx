// The winners of all designs, as pictures.

import { h } from "preact";
import { choice_of, Empty, link, Panel } from "../components";
import { Machine } from "../figure";
import { count, number, words } from "../format";
import { PageProps } from "../page";
import { set_query } from "../route";

const kFirst = 24;

export function Machines({ query, campaign: { designs } }: PageProps) {
  const shown = designs.filter((one) => [one.mission, ""].includes(query.mission ?? "") && [one.method, ""].includes(query.method ?? ""));
  const drawn = shown.filter((one) => one.best);
  const most = query.all ? drawn.length : kFirst;
  return <div>
    <h1>Control software <small>of the best candidate of each design</small></h1>
    {designs.length > 1 && <div class="tools">
      {choice_of("Mission", designs.map((one) => one.mission))}
      {choice_of("Method", designs.map((one) => one.method))}
      <span class="faint" role="status">{drawn.length} of {designs.length} designs</span>
    </div>}
    {drawn.length === 0 && <Empty>{shown.length > 0 ? "No design has a best candidate yet: there is one after the first iteration." : "No design has this mission and method."}</Empty>}
    <div class="columns">{drawn.slice(0, most).map(({ id, mission, method, repetition, best, state, ...one }) =>
      <Panel title={`${id}: ${words(mission)}, ${method}, ${repetition}`}>
        <p>{link(best!)} <span class="faint">mean {number(one.test_mean ?? one.best_mean)} {one.test_runs > 0 ? `in ${count(one.test_runs, "test")}` : "in its races"} (higher is better), {state}</span></p>
        <Machine of={best!} version={best!} />
      </Panel>)}</div>
    {drawn.length > most && <div class="tools"><button onClick={() => set_query({ all: 1 })}>Show all {drawn.length}</button></div>}
  </div>;
}
