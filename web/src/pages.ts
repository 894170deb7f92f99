// All pages, one per line, in the order of the navigation.
import { is_snapshot } from "./api";
import { Page } from "./page";
import { Campaigns } from "./pages/campaigns";
import { DesignPage } from "./pages/design";
import { RacePage } from "./pages/race";
import { RunPage } from "./pages/run";
import { CandidatePage } from "./pages/candidate";
import { Machines } from "./pages/machines";
import { Results } from "./pages/results";
import { Space } from "./pages/space";
import { Modules } from "./pages/modules";
import { Fleet } from "./pages/fleet";
import { Data } from "./pages/data";

const all: Page[] = [
  { pattern: ":c?", label: "Campaigns", letter: "o", view: Campaigns },
  { pattern: ":c/:d", label: "Design", letter: "d", view: DesignPage },
  { pattern: ":c/:d/race/:iteration?", label: "Race", letter: "r", view: RacePage,
    keys: [["← → ↑ ↓", "move the cell in the matrix"], ["Enter", "watch the run of the cell"], ["Esc", "leave the cell"]] },
  { pattern: ":c/runs/:id", label: "Run", view: RunPage,
    keys: [["space", "play or pause"], ["← →", "one second back or forward"], [", .", "one cycle back or forward"], ["[ ]", "slower or faster"],
      ["Home End", "to the start or the end"]] },
  { pattern: ":c/:d/space", label: "Search space", letter: "p", view: Space },
  { pattern: ":c/:candidate", label: "Candidate", view: CandidatePage },
  { pattern: ":c/machines", label: "Machines", letter: "m", view: Machines },
  { pattern: ":c/modules", label: "Modules", letter: "u", view: Modules },
  { pattern: ":c/results", label: "Results", letter: "e", view: Results },
  { pattern: "fleet", label: "Fleet", letter: "f", view: Fleet },
  { pattern: ":c/sql", label: "Data", letter: "s", view: Data, keys: [["Ctrl Enter", "ask"]] },
];

/// A snapshot file cannot run SQL.
export const pages = all.filter((page) => !is_snapshot || page.view !== Data);
