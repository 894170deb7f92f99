import { Component, h } from "preact";
import { Choice, Empty, Panel, Table } from "../components";
import { Figure } from "../figure";
import { number, percent, shell_word, words } from "../format";
import { Get } from "../get";
import { Page, PageProps } from "../page";
import { href } from "../route";
import { Columns, Design } from "../types";
import { version_of } from "./campaigns";
import { rows_of } from "./design";

/// A module's use by one method; numbers by mission.
interface Use { module: string; method: string; of: Record<string, { count: number | null; rate: number | null; reachable: number | null }> }

function quoted(text: string): string { return "'" + text.replace(/'/g, "''") + "'"; }

class Modules extends Component<PageProps, {}> {
  private table(c: string, rows: Use[], missions: string[]) {
    const sql = (one: Use, mission: string) => "SELECT d.design, d.best_candidate, m.occurrences, m.reachable FROM v_designs AS d JOIN v_modules AS m ON m.candidate = d.best_candidate"
      + ` WHERE d.state = 'finished' AND d.mission = ${quoted(mission)} AND d.method = ${quoted(one.method)} AND m.module = ${quoted(one.module)}`;
    return <Table<Use> name="m" caption="Modules of winners" rows={rows} sort="module" row_key={(one) => `${one.method} ${one.module}`}
      columns={[
        { key: "module", value: (one) => words(one.module) },
        { key: "method" },
        ...missions.map((mission) => ({
          key: mission, label: words(mission), value: (one: Use) => one.of[mission]?.rate,
          title: "share of the winners that have it; mean count in a winner; how many of these are in states that can be reached",
          show: (one: Use) => {
            const use = one.of[mission];
            if (!use || use.rate === null) return <span class="faint">–</span>;
            const part = use.rate;
            return <a class="meter-cell" href={href([c, "sql"], { q: sql(one, mission) })} title={`which designs; ${percent(use.reachable ?? 0)} have it in a state that can be reached`}>
              <span class="meter" aria-hidden="true"><span style={{ width: `${100 * part}%` }} /></span>{percent(part)}<span class="faint small">{number(use.count, 2)}</span></a>;
          },
        })),
      ]} />;
  }

  render() {
    const { params: { c }, live, query } = this.props;
    const campaign = live.campaigns.find((one) => one.c === c);
    if (!campaign) return <Empty>There is no campaign {c} here. <a href="#/">All campaigns</a></Empty>;
    const finished = campaign.designs.filter((one) => one.state === "finished").length;
    const mission = query.mission ?? "", method = query.method ?? "";
    const choice = (name: string, value: string, values: string[]) =>
      <Choice label={name} name={name} value={value} options={[["all", ""], ...values.map((one): [string, string] => [words(one), one])]} />;
    const distinct = (of: (one: Design) => string) => [...new Set(campaign.designs.map(of))].sort();
    const nothing = <Panel title="How often winners have each module"><Empty>{finished === 0 ? "No design has finished yet: modules are counted in the machines that won." : "No winner here is a machine of modules: networks and parameters of programs have none."}</Empty></Panel>;
    const version = version_of(campaign);
    return <div>
      <h1>Modules <span class="light">of the winners of {finished === 1 ? "1 finished design" : `${finished} finished designs`}</span></h1>
      <div class="tools">{choice("mission", mission, distinct((one) => one.mission))}{choice("method", method, distinct((one) => one.method))}</div>
      {finished === 0 ? nothing : <Get<Columns> path={`${c}/modules`} version={version} render={(columns) => {
        const uses = new Map<string, Use>();
        for (const row of rows_of(columns)) {
          const [module, at, by] = [String(row.module), String(row.mission), String(row.method)];
          if (mission && at !== mission || method && by !== method) continue;
          const use = uses.get(by + " " + module) ?? { module, method: by, of: {} };
          use.of[at] = { count: row.avg_occurrences as number | null, rate: row.occurrence_rate as number | null, reachable: row.reachable_rate as number | null };
          uses.set(by + " " + module, use);
        }
        // Networks and parameters of programs have no modules: rows without any say nothing.
        const some = [...uses.values()].filter((use) => Object.values(use.of).some((one) => one.rate));
        return some.length === 0 ? nothing : <div class="grid">
          <Panel title="How often winners have each module" command={`swarmsmith figure modules ${shell_word(campaign.store)}${mission && ` --mission ${shell_word(mission)}`}${method && ` --method ${shell_word(method)}`} -o modules.svg`}>
            <Figure key={mission + "/" + method} c={c} kind="modules" options={{ mission, method }} name="Modules of winners" version={version} missing={(error) => <Empty>{error.message}</Empty>} /></Panel>
          <Panel title="In numbers">{this.table(c, some, mission ? [mission] : distinct((one) => one.mission))}</Panel>
        </div>;
      }} />}
    </div>;
  }
}

export const modules: Page = {
  pattern: ":c/modules", title: () => "Modules", view: Modules,
  nav: { label: "Modules", letter: "u", path: ({ c }) => [c, "modules"] },
};
