import { h } from "preact";
import { is_snapshot } from "../api";
import { choice_of, command, Empty, Panel, Table } from "../components";
import { Figure } from "../figure";
import { count, in_order, number, percent, shell_word, words } from "../format";
import { Get } from "../get";
import { PageProps } from "../page";
import { href } from "../route";
import { Columns, Row } from "../types";
import { version_of } from "./campaigns";
import { rows_of } from "./design";

/// How one method uses a module; rows by mission.
interface Use { module: string; method: string; of: Record<string, Row> }

function quoted(text: string): string { return "'" + text.replace(/'/g, "''") + "'"; }

function table(c: string, rows: Use[], missions: string[]) {
  return <Table name="m" caption="Modules of winners" rows={rows} sort="module" row_key={({ method, module }) => `${method} ${module}`}
    columns={[{ key: "module", value: (one) => words(one.module) }, "method", ...missions.map((mission) => ({
      key: mission, value: ({ of }: Use) => of[mission]?.occurrence_rate,
      title: "share of the winners that have it; mean count in a winner; how many of these are in states that can be reached",
      show: ({ module, method, of }: Use) => {
        const use = of[mission];
        const part = use?.occurrence_rate as number | null;
        if (!use || part === null) return <span class="faint">–</span>;
        const sql = "SELECT d.design, d.best_candidate, m.occurrences, m.reachable FROM v_designs AS d JOIN v_modules AS m ON m.candidate = d.best_candidate"
          + ` WHERE d.state = 'finished' AND d.mission = ${quoted(mission)} AND d.method = ${quoted(method)} AND m.module = ${quoted(module)}`;
        return <a class="meter-cell" href={is_snapshot ? undefined : href([c, "sql"], { q: sql })} title={`which designs; ${percent(Number(use.reachable_rate))} have it in a state that can be reached`}>
          <span class="bar" aria-hidden="true"><span style={{ width: `${100 * part}%` }} /></span>{percent(part)}<small>{number(use.avg_occurrences as number, 2)}</small></a>;
      },
    }))]} />;
}

export function Modules({ params: { c }, campaign, query: { mission = "", method = "" } }: PageProps) {
  const { designs } = campaign;
  const finished = designs.filter(({ state }) => state === "finished").length;
  const missions = in_order(designs.map((one) => one.mission));
  const title = "How often winners have each module";
  const nothing = <Panel title={title}><Empty>{finished ? "No winner here is a machine of modules." : "No design has finished yet: modules are counted in the machines that won."}</Empty></Panel>;
  const version = version_of(designs);
  const option = (name: string, value: string) => value && `--${name} ${shell_word(value)} `;
  return <div>
    <h1>Modules <small>of the winners of {count(finished, "finished design")}</small></h1>
    <div class="tools">{choice_of("Mission", missions)}{choice_of("Method", designs.map((one) => one.method))}</div>
    {finished === 0 ? nothing : <Get<Columns> path={`${c}/modules`} version={version} render={(columns) => {
      const uses: Record<string, Use> = {};
      for (const row of rows_of(columns)) {
        const [module, at, by] = [row.module, row.mission, row.method].map(String);
        if (mission && at !== mission || method && by !== method) continue;
        (uses[by + " " + module] ??= { module, method: by, of: {} }).of[at] = row;
      }
      // Networks and parameters of programs have no modules; rows without any use are not shown.
      const some = Object.values(uses).filter(({ of }) => Object.values(of).some((one) => one.occurrence_rate));
      return some.length === 0 ? nothing : <div class="grid">
        <Panel title={title} command={command("figure modules", option("mission", mission) + option("method", method) + "-o modules.svg")}>
          <Figure key={mission + "/" + method} kind="modules" options={{ mission, method }} name="Modules of winners" version={version} /></Panel>
        <Panel wide={!mission && missions.length > 2} title="In numbers">{table(c, some, mission ? [mission] : missions)}</Panel>
      </div>;
    }} />}
  </div>;
}
