// A candidate: its machine, where it comes from, what it scored, and how it ended.

import { Component, h } from "preact";
import { feed } from "../api";
import { Copy, Empty, Fact, Panel, Table } from "../components";
import { Figure } from "../figure";
import { id_of, number, shell_word, whole, words } from "../format";
import { Get } from "../get";
import { Page, PageProps } from "../page";
import { href } from "../route";
import { Cell } from "../types";

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

interface Later { id: string; purpose: string; source: string; seed: number; score: number | null }

interface Answer {
  candidate: Candidate;
  ancestors: Candidate[];
  scores: { id: string[]; pair: number[]; instance: number[]; seed: number[]; iteration: number[]; score: (number | null)[] };
  later: Later[];
}

function parameters_of(candidate: Candidate): [string, Cell][] {
  const { parameters } = candidate;
  const values = typeof parameters === "string" ? JSON.parse(parameters || "{}") : parameters ?? {};
  return Object.entries(values as Record<string, Cell>);
}

/// How it ended, in a sentence.
function fate(one: Candidate) {
  if (one.eliminated_in === null) return <span class="good">never dropped</span>;
  return <span>dropped in iteration {one.eliminated_in}{one.eliminated_at !== null && ` at step ${whole(one.eliminated_at)}`}
    {one.eliminated_by && `: ${words(one.eliminated_by)}`}</span>;
}

class CandidatePage extends Component<PageProps, {}> {
  render() {
    const { c, candidate } = this.props.params;
    return <Get<Answer> path={`${c}/candidates/${candidate}`} render={(data) => this.answer(data)} />;
  }

  private answer({ candidate: one, ancestors, scores, later }: Answer) {
    const { c } = this.props.params;
    const id = id_of("c", one.candidate)!, d = id_of("d", one.design)!;
    const store = feed.live?.campaigns.find((campaign) => campaign.c === c)?.store ?? "STORE";
    const parameters = parameters_of(one);
    const rows = scores.pair.map((pair, at) => ({ pair, id: scores.id[at], instance: scores.instance[at], seed: scores.seed[at], iteration: scores.iteration[at], score: scores.score[at] }));
    return <div>
      <h1>Candidate {id} <span class="sub">of <a href={href([c, d])}>{d}</a></span></h1>
      <div class="columns">
        <Panel title="In the race">
          <dl class="facts">
            <Fact name="mean score" title="higher is better">{number(one.mean)}</Fact>
            <Fact name="runs">{whole(one.runs)}</Fact>
            <Fact name="made in iteration">{whole(one.iteration)}</Fact>
            {one.n_states !== null && <Fact name="states, transitions">{one.n_states}, {one.n_transitions}</Fact>}
            <Fact name="end"><a class="plain" href={href([c, d, "race", String(one.eliminated_in ?? one.iteration)], { cell: id })}>{fate(one)}</a></Fact>
          </dl>
          <h3>Ancestors</h3>
          {ancestors.length === 0 ? <p class="faint">None: it was drawn from the whole space{one.parent !== null && `, its parent ${id_of("c", one.parent)} is not in the store`}.</p>
            : <ol class="ancestors">{ancestors.map((other) => <li><a href={href([c, id_of("c", other.candidate)!])}>{id_of("c", other.candidate)}</a>
              <span class="faint"> iteration {other.iteration}, mean {number(other.mean)} of {whole(other.runs)} runs</span></li>)}</ol>}
        </Panel>
        <Panel title="Control software">
          <Figure c={c} kind="machine" options={{ candidate: id }} name={`control software of ${id}`}
            missing={() => <Empty>This candidate is no machine, tree or network: it has its parameters alone.</Empty>} />
          {one.fsm_config && <div><pre class="small">{one.fsm_config}</pre>
            <div class="tools"><Copy text={one.fsm_config} what="Copy text" />
              <Copy text={`swarmsmith show ${id} ${shell_word(store)}`} what="Copy as command" /></div></div>}
        </Panel>
        <Panel title="Scores by pair, in its races">
          <Table<(typeof rows)[0]> name="r" caption={`scores of ${id} by pair`} rows={rows} row_key={(row) => `${row.iteration} ${row.pair}`} page_size={15}
            empty="It has not run yet." columns={[
              { key: "pair" },
              { key: "score", show: (row) => row.score === null ? "rejected" : number(row.score) },
              { key: "run", show: (row) => <a href={href([c, "runs", row.id])} aria-label={`watch ${row.id}`}>watch</a> },
              { key: "seed" },
              { key: "instance" },
              { key: "iteration" },
            ]} />
        </Panel>
        <Panel title="Later scores">
          <Table<Later> name="l" caption={`later scores of ${id}`} rows={later} row_key={(row) => row.id} page_size={15}
            empty={<span>None. Winners are tested at a design's end; any candidate is scored by <code>swarmsmith evaluate {id} --store {shell_word(store)} --seeds 1-10</code></span>} columns={[
              { key: "purpose" },
              { key: "source" },
              { key: "seed" },
              { key: "score" },
              { key: "run", show: (row) => row.source === "real" && !row.id.startsWith("r") ? null : <a href={href([c, "runs", row.id])} aria-label={`watch ${row.id}`}>watch</a> },
            ]} />
        </Panel>
        {parameters.length > 0 && <Panel title="Parameters">
          <Table<[string, Cell]> name="p" caption={`parameters of ${id}`} rows={parameters} page_size={30} columns={[
            { key: "parameter", value: ([name]) => name },
            { key: "value", value: ([, value]) => value, show: ([, value]) => value === null ? "not used" : typeof value === "number" ? number(value, 6) : String(value) },
          ]} />
        </Panel>}
      </div>
    </div>;
  }
}

export const candidate: Page = { pattern: ":c/:candidate", title: ({ candidate: id }) => `candidate ${id}`, view: CandidatePage };
