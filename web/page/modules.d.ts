declare module 'core' {
  const loadCore: (options: object) => Promise<unknown>;
  export default loadCore;
}
declare module '*.toml' {
  const text: string;
  export default text;
}
