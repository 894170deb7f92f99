// A candidate: its machine, its origin, its scores, and how it was dropped.

import { h } from "preact";
import { command, Copy, Empty, link, pairs, Panel, place_of, store_word, Table } from "../components";
import { Machine } from "../figure";
import { count, id_of, number, whole, words } from "../format";
import { Get } from "../get";
import { PageProps } from "../page";
import { href } from "../route";
import { Cell, Columns, Row } from "../types";
import { rows_of } from "./design";

/// A row of v_candidates; parameters are an object, or its JSON text.
interface Candidate {
  candidate: number | string;
  design: number | string;
  iteration: number;
  parent: number | string | null;
  n_states: number | null;
  n_transitions: number | null;
  fsm_config: string | null;
  parameters: Record<string, Cell> | string | null;
  runs: number;
  mean: number | null;
  eliminated_in: number | null;
  eliminated_at: number | null;
  eliminated_by: string | null;
}

interface Answer { candidate: Candidate; ancestors: Candidate[]; scores: Columns; later: Row[] }

/// What happened to the candidate, in a sentence.
function fate({ eliminated_in, eliminated_at, eliminated_by }: Candidate) {
  return eliminated_in === null ? <span class="good">never dropped</span>
    : `dropped in iteration ${eliminated_in}${eliminated_at !== null ? ` at step ${whole(eliminated_at)}` : ""}${eliminated_by ? `: ${words(eliminated_by)}` : ""}`;
}

/// A link to the run, except for runs that cannot be simulated again: runs of programs, and real
/// runs with only a score.
function watch({ id, source }: Row) {
  return source !== "command" && (source !== "real" || String(id)[0] === "r") && <a href={place_of(String(id))} aria-label={`watch ${id}`}>watch</a>;
}

function shown(c: string, { candidate: one, ancestors, scores, later }: Answer) {
  const id = id_of("c", one.candidate)!, d = id_of("d", one.design)!;
  const parameters = Object.entries((typeof one.parameters === "string" ? JSON.parse(one.parameters || "{}") : one.parameters ?? {}) as Record<string, Cell>);
  return <div>
    <h1>Candidate {id} <small>of {link(d)}</small></h1>
    <div class="columns">
      <Panel title="In the race">
        {pairs("facts", [
          ["mean score", number(one.mean), "higher is better"],
          ["runs", whole(one.runs)],
          ["made in iteration", whole(one.iteration)],
          /--nstates/.test(one.fsm_config ?? "") && ["states, transitions", `${one.n_states}, ${one.n_transitions}`],
          ["end", <a class="plain" href={href([c, d, "race", String(one.eliminated_in ?? one.iteration)], { cell: id })}>{fate(one)}</a>]])}
        <h3>Ancestors</h3>
        {ancestors.length === 0 ? <p class="faint">None{one.iteration > 0 && ": it was drawn from the whole space"}{one.parent !== null && `, its parent ${id_of("c", one.parent)} is not in the store`}.</p>
          : <ol class="ancestors">{ancestors.map(({ candidate, iteration, mean, runs }) => <li>{link(id_of("c", candidate)!)}
            <span class="faint"> iteration {iteration}, mean {number(mean)} of {count(runs, "run")}</span></li>)}</ol>}
      </Panel>
      <Panel title="Control software">
        <Machine of={id} missing={<Empty>This candidate is not a machine, tree or network: it has only parameters.</Empty>} />
        {one.fsm_config && [<pre class="small">{one.fsm_config}</pre>,
          <div class="tools"><Copy text={one.fsm_config} what="Copy text" /><Copy text={command(`show ${id}`)} /></div>]}
      </Panel>
      <Panel title="Scores by pair, in its races">
        <Table name="r" page_size={15} caption={`scores of ${id} by pair`} rows={rows_of(scores)} row_key={({ iteration, pair }) => `${iteration} ${pair}`}
          empty="It has not run yet." columns={["pair", { key: "score", show: (row) => row.score === null ? "rejected" : number(row.score as number) },
            { key: "run", show: watch }, "seed", "instance", "iteration"]} />
      </Panel>
      <Panel title="Later scores">
        <Table name="l" page_size={15} caption={`later scores of ${id}`} rows={later} row_key={(row) => String(row.id)}
          empty={["None. Winners are tested at a design's end; you can score any candidate: ", <code>swarmsmith evaluate {id} --store {store_word()} --seeds 1-10</code>]}
          columns={["purpose", "source", "seed", "score", { key: "run", show: watch }]} />
      </Panel>
      {parameters.length > 0 && <Panel title="Parameters">
        <Table name="p" caption={`parameters of ${id}`} rows={parameters} columns={[
          { key: "parameter", value: ([name]) => name },
          { key: "value", value: ([, value]) => value, show: ([, value]) => value === null ? "not used" : typeof value === "number" ? number(value, 6) : value }]} />
      </Panel>}
    </div>
  </div>;
}

export function CandidatePage({ params: { c, candidate } }: PageProps) {
  return <Get<Answer> path={`${c}/candidates/${candidate}`} render={(answer) => shown(c, answer)} />;
}
