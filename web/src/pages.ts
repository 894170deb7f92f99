// All pages, a line each; the order is that of the navigation.
import { Page } from "./page";
import { campaigns } from "./pages/campaigns";
import { design } from "./pages/design";
import { race } from "./pages/race";
import { run } from "./pages/run";
import { candidate } from "./pages/candidate";
import { machines } from "./pages/machines";
import { results } from "./pages/results";
import { space } from "./pages/space";
import { modules } from "./pages/modules";
import { fleet } from "./pages/fleet";
import { data } from "./pages/data";

export const pages: Page[] = [
  campaigns,
  design,
  race,
  run,
  space,
  candidate,
  machines,
  modules,
  results,
  fleet,
  data,
];
