// Types that are missing in Debian's Preact 8.
declare namespace JSX {
  interface IntrinsicAttributes { key?: string | number }
}
