// What the types of Debian's Preact 8 leave out.
declare namespace JSX {
  interface IntrinsicAttributes { key?: string | number }
}
