import { Campaign, Design, Live } from "./types";

export interface PageProps {
  /// Of the page's pattern: c "c1", d "d3", ...
  params: Record<string, string>;
  query: Record<string, string>;
  live: Live;
  /// Those of params.c and params.d: where one is not there, the page is not shown.
  campaign: Campaign;
  design: Design;
}

export interface Page {
  /// Its address: match() in route.ts.
  pattern: string;
  label: string;
  /// g and the letter go there; a page without one is not in the navigation.
  letter?: string;
  view: ((props: PageProps) => JSX.Element | null) | (new (props?: PageProps, context?: any) => any);
  /// Keys of its own and what they do, for the help.
  keys?: [key: string, what: string][];
}
