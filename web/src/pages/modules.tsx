import { Component, h } from "preact";
import { Copy, Empty, Panel, Table } from "../components";
import { Figure } from "../figure";
import { number, percent, shell_word, words } from "../format";
import { Get } from "../get";
import { Page, PageProps } from "../page";
import { href, set_query } from "../route";
import { Columns, Design } from "../types";
import { version_of } from "./campaigns";
import { rows_of } from "./design";

interface Use { module: string; mission: string; method: string; count: number | null; rate: number | null; reachable: number | null }

class Modules extends Component<PageProps, {}> {
  private table(c: string, all: Use[], mission: string, method: string) {
    const rows = all.filter((one) => (!mission || one.mission === mission) && (!method || one.method === method));
    const sql = (one: Use) => `SELECT d.design, d.best_candidate, m.occurrences, m.reachable FROM v_designs AS d JOIN v_modules AS m ON m.candidate = d.best_candidate`
      + ` WHERE d.state = 'finished' AND d.mission = '${one.mission.replace(/'/g, "''")}' AND d.method = '${one.method.replace(/'/g, "''")}' AND m.module = '${one.module.replace(/'/g, "''")}'`;
    const rate = (part: number | null) => part === null ? <span class="faint">not in this flavour</span>
      : <span class="meter-cell"><span class="meter" aria-hidden="true"><span style={{ width: `${100 * part}%` }} /></span>{percent(part)}</span>;
    return <Table<Use> name="m" caption="Modules of winners" rows={rows} sort="-rate" row_key={(one) => `${one.mission} ${one.method} ${one.module}`} page_size={60}
      columns={[
        { key: "module", label: "module", value: (one) => words(one.module) },
        { key: "mission", label: "mission", value: (one) => words(one.mission) },
        { key: "method", label: "method", value: (one) => one.method },
        { key: "count", label: "mean count", numeric: true, value: (one) => one.count, show: (one) => number(one.count, 3), title: "in a winner's machine" },
        { key: "rate", label: "winners that have it", numeric: true, value: (one) => one.rate, show: (one) => rate(one.rate) },
        { key: "reachable", label: "in states that can be reached", numeric: true, value: (one) => one.reachable, show: (one) => one.reachable === null ? "–" : percent(one.reachable) },
        { key: "designs", label: "designs", value: () => "", show: (one) => one.rate ? <a href={href([c, "sql"], { q: sql(one) })} aria-label={`designs that use ${words(one.module)}`}>which</a> : "" },
      ]} />;
  }

  render() {
    const { params: { c }, live, query } = this.props;
    const campaign = live.campaigns.find((one) => one.c === c);
    if (!campaign) return <Empty>There is no campaign {c} here. <a href="#/">All campaigns</a></Empty>;
    const finished = campaign.designs.filter((one) => one.state === "finished").length;
    const mission = query.mission ?? "", method = query.method ?? "";
    const choice = (name: string, value: string, values: string[]) => <label>{name} <select onChange={(e) => set_query({ [name]: (e.target as HTMLSelectElement).value })}>
      <option value="" selected={value === ""}>all</option>{values.map((one) => <option value={one} selected={one === value}>{words(one)}</option>)}</select></label>;
    const distinct = (of: (one: Design) => string) => [...new Set(campaign.designs.map(of))].sort();
    const nothing = <Empty>{finished === 0 ? "No design has finished yet: modules are counted in the machines that won." : "No winner here is a machine of modules: networks and parameters of programs have none."}</Empty>;
    const version = version_of(campaign);
    return <div>
      <h1>Modules <span class="light">of the winners of {finished === 1 ? "1 finished design" : `${finished} finished designs`}</span></h1>
      <div class="tools">{choice("mission", mission, distinct((one) => one.mission))}{choice("method", method, distinct((one) => one.method))}</div>
      <div class="grid">
        <Panel title="How often winners have each module" tools={<Copy what="Copy as command" text={`swarmsmith figure modules ${shell_word(campaign.store)}${mission && ` --mission ${shell_word(mission)}`}${method && ` --method ${shell_word(method)}`} -o modules.svg`} />}>
          <Figure key={mission + "/" + method} c={c} kind="modules" options={{ mission, method }} name="Modules of winners" version={version} missing={(error) => finished ? <Empty>{error.message}</Empty> : nothing} /></Panel>
        <Panel title="In numbers">
          <Get<Columns> path={`${c}/modules`} version={version} render={(columns) => {
            const uses = rows_of(columns).map((row) => ({ module: String(row.module), mission: String(row.mission), method: String(row.method),
              count: row.avg_occurrences as number | null, rate: row.occurrence_rate as number | null, reachable: row.reachable_rate as number | null }));
            return uses.length === 0 ? nothing : this.table(c, uses, mission, method);
          }} /></Panel>
      </div>
    </div>;
  }
}

export const modules: Page = {
  pattern: ":c/modules", title: () => "Modules", view: Modules,
  nav: { label: "Modules", letter: "u", path: ({ c }) => [c, "modules"] },
};
