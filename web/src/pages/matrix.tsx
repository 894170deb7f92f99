// Which method wins where, by how much, and how sure that is: methods by missions, one matrix a source.

import { h } from "preact";
import { Empty, link, Panel, Table } from "../components";
import { count, number, words } from "../format";
import { Get } from "../get";
import { current_route, href } from "../route";
import { Columns, Row } from "../types";
import { rows_of } from "./design";

interface Cell { n: number; runs: number; mean: number; low: number | null; high: number | null; rank: number; letters: string; behind: number; p_behind: number | null }
interface Matrix { source: string; missions: string[]; methods: { method: string; mean_rank: number | null; cells: (Cell | null)[] }[] }
interface Answer { said: string; matrices: Matrix[]; notes: string[]; nothing?: string }

/// What the letters say, as a person asks it.
function about({ n, runs, behind, p_behind, rank }: Cell): string {
  const p = p_behind === null ? "" : `, p = ${number(p_behind, 2)} by Holm`;
  return `n = ${n}, ${count(runs, "run")}${rank > 1 ? `; ${number(behind)} behind the best${p}` : "; the best"}`;
}

function cell(c: string, mission: string, method: string, one: Cell | null) {
  if (!one) return <td class="n">–</td>;
  const chosen = current_route().query.of === `${mission}/${method}`;
  return <td class={chosen ? "n chosen" : "n"} title={about(one)}>
    <a href={href([c, "results"], { ...current_route().query, of: chosen ? null : `${mission}/${method}` })}
      aria-label={`${words(mission)}, ${method}: mean ${number(one.mean)}, rank ${one.rank}, ${about(one)}; its designs`}>
      {one.rank === 1 ? <b class="good">{number(one.mean)}</b> : number(one.mean)}</a>
    {one.low !== null && <small> {number(one.low, 3)} to {number(one.high, 3)}</small>} <span class="rank">{number(one.rank)}</span> <i>{one.letters}</i></td>;
}

function table(c: string, { source, missions, methods }: Matrix) {
  return <div class="scroll" tabIndex={0} role="region" aria-label={`methods by missions in ${source}`}><table class="matrix">
    <caption>{source}</caption>
    <thead><tr><th scope="col">method</th><th scope="col" class="n" title="over the missions; 1 is best">mean rank</th>{missions.map((mission) => <th scope="col" class="n">{words(mission)}</th>)}</tr></thead>
    <tbody>{methods.map(({ method, mean_rank, cells }) => <tr><th scope="row">{method}</th><td class="n">{number(mean_rank, 3)}</td>
      {cells.map((one, i) => cell(c, missions[i], method, one))}</tr>)}</tbody>
  </table></div>;
}

/// The designs of the cell that was chosen, the best first.
function designs_of(c: string, version: string, chosen: string) {
  const [mission, method] = chosen.split("/");
  return <Get<Columns> path={`${c}/leaderboard`} version={version} render={(data) => <div>
    <h3>{words(mission)}, {method}: its designs, the best first</h3>
    <Table<Row> name="of" caption={`designs of ${method}, ${words(mission)}`} rows={rows_of(data).filter((one) => one.mission === mission && one.method === method)}
      columns={[{ key: "design", show: (one) => link("d" + one.design) }, "repetition", { key: "candidate", label: "winner" },
        { key: "test_mean", label: "mean of tests" }, { key: "test_runs", label: "tests" }, { key: "race_mean", label: "mean in the race" }]} /></div>} />;
}

export function Methods({ c, version }: { c: string; version: string }) {
  const { of } = current_route().query;
  return <div class="grid"><Panel wide title="Methods by missions">
    <Get<Answer> path={`${c}/comparison/matrix`} version={version} render={(one) => one.nothing ? <Empty>{one.nothing}</Empty> : <div>
      {one.matrices.map((matrix) => table(c, matrix))}
      <p class="faint">Mean of the tests, its 95 % interval, <span class="rank">rank</span> and <i>letters</i>: methods of a mission that share a letter do not differ at 5 %
        (Wilcoxon's rank-sum tests of its pairs, with Holm's correction); {one.said}. A mean leads to its designs.</p>
      {one.notes.map((note) => <p class="faint">{note}</p>)}
      {of && designs_of(c, version, of)}</div>} />
  </Panel></div>;
}
