import { Campaign, Design, Live } from "./types";

export interface PageProps {
  /// Parameters of the page's pattern: c "c1", d "d3", ...
  params: Record<string, string>;
  query: Record<string, string>;
  live: Live;
  /// The campaign and design of params.c and params.d. If one does not exist, the page is not
  /// shown.
  campaign: Campaign;
  design: Design;
}

export interface Page {
  /// Pattern of its address: match() in route.ts.
  pattern: string;
  label: string;
  /// Pressing g and this letter opens the page. A page without a letter is not in the navigation.
  letter?: string;
  view: ((props: PageProps) => JSX.Element | null) | (new (props?: PageProps, context?: any) => any);
  /// Keys that the page itself handles, for the help.
  keys?: [key: string, what: string][];
}
