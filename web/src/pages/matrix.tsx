// Which method wins where, by how much, and how certain that is: methods by missions, one matrix
// per source.

import { h } from "preact";
import { link, Panel, Table } from "../components";
import { number, words } from "../format";
import { Get } from "../get";
import { set_query } from "../route";
import { Columns, Row } from "../types";
import { rows_of } from "./design";

interface Cell { n: number; mean: number; low: number | null; high: number | null; rank: number; letters: string; behind: number; p_behind: number | null }
interface Matrix { source: string; missions: string[]; methods: { method: string; mean_rank: number | null; cells: (Cell | null)[] }[] }
interface Answer { said: string; matrices: Matrix[] }

function cell(of: string, chosen: string, one: Cell | null) {
  return one ? <td class={of === chosen ? "n chosen" : "n"} title={`n = ${one.n}; ${number(one.behind)} behind the best, p = ${number(one.p_behind, 2)}`}>
    <button class="quiet" aria-pressed={of === chosen} aria-label={`designs of ${of}`} onClick={() => set_query({ of: of === chosen ? null : of })}>
      {number(one.mean)}</button> <small>{number(one.low, 3)} to {number(one.high, 3)}</small> <b>{number(one.rank)}</b> <i>{one.letters}</i></td> : <td class="n">–</td>;
}

function table({ source, missions, methods }: Matrix, chosen: string) {
  return <div class="scroll" tabIndex={0} role="region" aria-label={`methods by missions: ${source}`}><table class="matrix">
    <caption>{source}</caption>
    <thead><tr><th>method</th><th class="n">mean rank</th>{missions.map((mission) => <th class="n">{words(mission)}</th>)}</tr></thead>
    <tbody>{methods.map(({ method, mean_rank, cells }) => <tr><th scope="row">{method}</th><td class="n">{number(mean_rank, 3)}</td>
      {cells.map((one, i) => cell(`${missions[i]}/${method}`, chosen, one))}</tr>)}</tbody>
  </table></div>;
}

/// The designs of the chosen cell, best first.
function designs_of(c: string, version: string, chosen: string) {
  return <Get<Columns> path={`${c}/leaderboard`} version={version} render={(data) =>
    <Table<Row> name="of" caption={`designs of ${chosen}`} rows={rows_of(data).filter(({ mission, method }) => `${mission}/${method}` === chosen)}
      columns={[{ key: "design", show: ({ design }) => link("d" + design) }, "candidate", "test_mean", "test_runs", "race_mean"]} />} />;
}

export function Methods({ c, version, of }: { c: string; version: string; of: string }) {
  return <div class="grid"><Panel wide title="Methods by missions">
    <Get<Answer> path={`${c}/comparison/matrix`} version={version} render={({ matrices, said }) => <div>
      {matrices.map((one) => table(one, of))}
      <p class="faint">Mean of the tests, its 95 % interval, <b>rank</b>, <i>letters</i>: methods of a mission that share one do not differ at 5 %
        (rank-sum tests, Holm's correction); {said}. Click a mean to see its designs.</p></div>} />
    {of && designs_of(c, version, of)}
  </Panel></div>;
}
