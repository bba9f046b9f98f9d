// The explorer: holds the state, asks the core, and shows the answers.
import 'uplot/dist/uPlot.min.css';
import './style.css';

import { Core, InputError, Overtaken } from './core';
import { csv, save, savePng, svgFile } from './downloads';
import { aboutOf, examples } from './examples';
import { GearView } from './gears';
import { Inputs, missingInputs, singleInput } from './inputs';
import { escapeText, short, typed } from './numbers';
import { compiledCore, embeddedDrive, startWorker } from './parts';
import { branchChart, contourMap, figurePlot, phasePlane, positionsOverTime, tracesOf, type Traces } from './pictures';
import { dark, draw, light, type Plot, type Theme } from './plot';
import type { AnswerReply, ChartReply, DriveReply, DriveText, Fault, FigureReply, MapReply, MarginsReply, Parameter, Replied } from './replies';
import { addressOf, commandOf, setOptions, stateOf, withSetting, type State } from './state';
import { storySteps } from './story';
import { TraceView } from './traces';

const byId = <T extends Element = HTMLElement>(id: string): T => document.getElementById(id) as unknown as T;

/** Milliseconds without a change after which a slider rests. */
const restAfter = 220;
/** Seconds that a search may take before the page asks. */
const searchSeconds = 120;

class Explorer {
  private state!: State;
  private facts: DriveReply | null = null;
  private answer: Replied<AnswerReply> | null = null;
  private map: { replied: Replied<MapReply> | Replied<ChartReply>; key: string } | null = null;
  private figure: Replied<FigureReply> | null = null;
  private theme: Theme = light;
  private resting: ReturnType<typeof setTimeout> | undefined;
  private isAsking = false;
  private isStale = false;
  /** Counts what the user did; an answer to older input is dropped. */
  private turn = 0;
  private readonly plots = new Map<string, Plot>();
  private readonly inputs = new Inputs(byId('inputs'), (path, text, isDragging) => this.change(path, text, isDragging));
  private readonly traces: TraceView;
  private readonly gears: GearView;
  private readonly story = storySteps(examples.get('first-servo')!);

  constructor(private readonly core: Core) {
    this.gears = new GearView(
      {
        picture: byId<SVGSVGElement>('gear-picture'),
        play: byId('gear-play'), back: byId('gear-back'), on: byId('gear-on'), slider: byId('gear-time'), words: byId('gear-words'),
      },
      (time) => this.traces?.point(time),
    );
    this.traces = new TraceView(byId('traces'), () => {});
  }

  // ---- beginning --------------------------------------------------------------------------------

  async start(): Promise<void> {
    this.useTheme(localStorageItem('theme') ?? (matchMedia('(prefers-color-scheme: dark)').matches ? 'dark' : 'light'));
    this.listExamples();
    this.listFigures();
    this.listen();
    const own = embeddedDrive();
    const [first, toml] = own ? ['', own.toml] : (examples.entries().next().value as [string, string]);
    const start: State = {
      drive: { toml, name: own?.name ?? `${first}.toml`, settings: [] }, example: first,
      view: 'explore', step: 1, figure: 2, x: '', y: '',
    };
    try {
      this.state = await stateOf(location.hash, start, examples);
    } catch (error) {
      this.state = start;
      this.tell(String((error as Error).message));
    }
    await this.load();
  }

  private listExamples(): void {
    const list = byId<HTMLSelectElement>('example');
    list.add(new Option('your own', ''));
    for (const name of examples.keys()) list.add(new Option(name, name));
    list.onchange = () => {
      const toml = examples.get(list.value);
      if (toml) void this.take({ toml, name: `${list.value}.toml`, settings: [] }, list.value);
    };
  }

  private listFigures(): void {
    const list = byId<HTMLSelectElement>('figure');
    for (let number = 2; number <= 15; ++number) list.add(new Option(`figure ${number}`, String(number)));
    list.onchange = () => {
      this.state.figure = Number(list.value);
      void this.showFigure();
    };
  }

  private listen(): void {
    for (const button of document.querySelectorAll<HTMLButtonElement>('[data-view]')) {
      button.onclick = () => void this.look(button.dataset.view as State['view']);
    }
    byId('theme').onclick = () => {
      this.useTheme(this.theme === light ? 'dark' : 'light');
      this.redraw();
    };
    byId('print').onclick = () => window.print();
    byId('stop').onclick = () => this.stop();
    byId('save-toml').onclick = () => void this.saveDrive();
    byId('copy-link').onclick = () => void this.copyLink();
    byId('map-go').onclick = () => void this.computeMap();
    byId('changes-go').onclick = () => void this.computeChanges();
    byId<HTMLSelectElement>('gear-motion').onchange = () => this.showMotion();
    for (const axis of ['x', 'y'] as const) {
      byId<HTMLSelectElement>(`map-${axis}`).onchange = (event) => {
        this.state[axis] = (event.target as HTMLSelectElement).value;
        void this.computeMap();
      };
    }
    byId('story-back').onclick = () => void this.toStep(this.state.step - 1);
    byId('story-next').onclick = () => void this.toStep(this.state.step + 1);
    byId('story-take').onclick = () => void this.look('explore');
    window.addEventListener('hashchange', () => void this.follow());
    this.listenToFiles();
  }

  private listenToFiles(): void {
    const input = byId<HTMLInputElement>('file');
    input.onchange = () => input.files?.[0] && void this.open(input.files[0]);
    const dropping = byId('dropping');
    const holdsFile = (event: DragEvent): boolean => event.dataTransfer?.types.includes('Files') ?? false;
    document.addEventListener('dragenter', (event) => holdsFile(event) && (dropping.hidden = false));
    document.addEventListener('dragover', (event) => event.preventDefault());
    document.addEventListener('dragleave', (event) => event.relatedTarget === null && (dropping.hidden = true));
    document.addEventListener('drop', (event) => {
      event.preventDefault();
      dropping.hidden = true;
      const file = event.dataTransfer?.files[0];
      if (file) void this.open(file);
    });
  }

  private useTheme(name: string): void {
    this.theme = name === 'dark' ? dark : light;
    document.documentElement.dataset.theme = name;
    byId('theme').textContent = name === 'dark' ? 'Light' : 'Dark';
    keepItem('theme', name);
  }

  // ---- the drive --------------------------------------------------------------------------------

  private async open(file: File): Promise<void> {
    const largest = 1024 * 1024; // of the core's reader
    if (file.size > largest) {
      this.tell(`${file.name} has ${short(file.size / largest, 3)} MiB. A drive's file has 1 MiB at most; the drive stays as it was.`);
      return;
    }
    await this.take({ toml: await file.text(), name: file.name, settings: [] }, '');
  }

  /** Another drive, which replaces the present one if it is sound. */
  private async take(drive: DriveText, example: string): Promise<void> {
    const before = { drive: this.state.drive, example: this.state.example, x: this.state.x, y: this.state.y };
    Object.assign(this.state, { drive, example, x: '', y: '' });
    if (!(await this.load())) {
      const isBroken = this.facts === null;
      Object.assign(this.state, isBroken ? {} : before);
      byId<HTMLSelectElement>('example').value = this.state.example;
    }
  }

  /** Shows the state from the beginning. False if its drive has faults. */
  private async load(): Promise<boolean> {
    this.showView();
    this.map = null;
    if (this.state.view === 'thesis') {
      await this.showFigure();
      if (!this.facts) await this.readDrive();
      return true;
    }
    if (this.state.view === 'story') {
      const step = this.story[this.state.step - 1]!;
      if (this.state.drive.toml !== step.drive.toml) Object.assign(this.state, { drive: step.drive, example: '', x: '', y: '' });
    }
    this.inputs.reset();
    if (!(await this.readDrive())) return false;
    this.rest();
    return true;
  }

  private async readDrive(): Promise<boolean> {
    try {
      const { reply } = await this.core.quick.ask<DriveReply>({ ask: 'drive', drive: this.state.drive });
      this.facts = reply;
    } catch (error) {
      this.refuse(error);
      return false;
    }
    this.showFaults([]);
    this.inputs.show(this.facts);
    byId<HTMLSelectElement>('example').value = this.state.example;
    byId('about').textContent = aboutOf(this.state.drive.toml) || this.state.drive.name;
    this.listAxes();
    if (this.state.view === 'story') this.showStep();
    this.showCommand();
    return true;
  }

  private change(path: string, text: string, isDragging: boolean): void {
    const before = this.state.drive;
    this.state.drive = withSetting(before, path, text);
    const parameter = this.facts?.parameters.find((one) => one.path === path);
    ++this.turn;
    this.core.thorough.giveUp();
    this.showCommand();
    if (!isDragging && (parameter?.kind === 'choice' || parameter?.kind !== 'number' || text === 'none')) {
      void this.readDrive().then((isRead) => isRead && this.rest());
      return;
    }
    this.ask();
    this.rest();
  }

  // ---- answers ----------------------------------------------------------------------------------

  /** The coarse answer: one request at a time, the latest input next. */
  private ask(): void {
    if (this.isAsking) {
      this.isStale = true;
      return;
    }
    this.isAsking = true;
    this.isStale = false;
    const { drive } = this.state;
    void this.core.quick
      .ask<AnswerReply>({ ask: 'answer', level: 'coarse', drive, seconds: 5 })
      .then((replied) => {
        this.showFaults([]);
        this.show(replied);
      })
      .catch((error) => this.refuse(error))
      .finally(() => {
        this.isAsking = false;
        if (this.isStale) this.ask();
      });
  }

  /** After a moment without a change: the fine answer, and what takes longer. */
  private rest(): void {
    clearTimeout(this.resting);
    this.resting = setTimeout(() => void this.settle(), restAfter);
  }

  private async settle(): Promise<void> {
    const turn = ++this.turn;
    const { drive } = this.state;
    void this.keepAddress();
    try {
      const replied = await this.thoroughly<AnswerReply>({ ask: 'answer', level: 'fine', drive, seconds: searchSeconds });
      if (turn !== this.turn) return;
      const facts = await this.core.quick.ask<DriveReply>({ ask: 'drive', drive });
      if (turn !== this.turn) return;
      this.facts = facts.reply;
      this.showFaults([]);
      this.inputs.show(facts.reply);
      this.show(replied);
      byId('spoken').textContent = replied.reply.headline;
    } catch (error) {
      this.refuse(error);
      return;
    }
    const isQuick = this.facts!.has_closed_form;
    const isInStory = this.state.view === 'story';
    const shows = (card: string): boolean => !isInStory || this.story[this.state.step - 1]!.cards.includes(card);
    if (shows('map')) await this.computeMap(turn);
    if (turn !== this.turn || !shows('changes')) return;
    if (isQuick || isInStory) await this.computeChanges(turn);
    else this.offerChanges();
  }

  /** On the second worker, with progress and a button to stop. */
  private async thoroughly<T>(request: object): Promise<Replied<T>> {
    const bar = byId<HTMLProgressElement>('progress');
    const late = setTimeout(() => {
      bar.hidden = false;
      bar.removeAttribute('value');
      byId('stop').hidden = false;
    }, 600);
    try {
      return await this.core.thorough.ask<T>(request, (share) => (bar.value = share));
    } finally {
      clearTimeout(late);
      bar.hidden = true;
      byId('stop').hidden = true;
    }
  }

  private stop(): void {
    ++this.turn;
    this.core.thorough.giveUp();
    byId('level').textContent += ' Stopped.';
  }

  private show(replied: Replied<AnswerReply>): void {
    this.answer = replied;
    const { reply } = replied;
    byId('headline').textContent = capital(reply.headline);
    document.title = `Gearlash: ${reply.headline}`;
    byId('ceiling').textContent = ceilingText(reply);
    const level = byId('level');
    level.className = reply.level;
    level.textContent = levelText(reply);
    if (reply.report !== null) byId('report').textContent = reply.report;
    this.showPictures();
    this.markHere();
  }

  private showPictures(): void {
    const { reply, numbers } = this.answer!;
    this.listMotions();
    if (reply.phase) this.put('phase', phasePlane(reply.phase, numbers, this.theme));
    else this.blank('phase', 'There is no motion to draw: it is proved without following one.');
    this.showMotion();
  }

  private listMotions(): void {
    const list = byId<HTMLSelectElement>('gear-motion');
    const names = ['the way there', ...(this.answer!.reply.phase?.motions ?? []).filter((motion) => motion.is_cycle && motion.columns).map((motion) => motion.name || 'cycle')];
    if (Array.from(list.options, (option) => option.text).join('|') === names.join('|')) return;
    const chosen = Math.max(0, list.selectedIndex);
    list.textContent = '';
    names.forEach((name, i) => list.add(new Option(name, String(i))));
    list.selectedIndex = Math.min(chosen, names.length - 1);
  }

  /** The motion that the gears and the traces follow. */
  private chosenMotion(): Traces | null {
    const { reply, numbers } = this.answer!;
    const chosen = byId<HTMLSelectElement>('gear-motion').selectedIndex;
    if (chosen > 0 && reply.phase) {
      const cycles = reply.phase.motions.map((motion, i) => [motion, i] as const).filter(([motion]) => motion.is_cycle && motion.columns);
      const cycle = cycles[chosen - 1];
      if (cycle) return { ...tracesOf(reply.phase, numbers, cycle[1]), title: cycle[0].name };
    }
    return reply.response ? tracesOf(reply.response, numbers) : null;
  }

  private showMotion(): void {
    if (!this.answer) return;
    const traces = this.chosenMotion();
    if (!traces) return;
    byId('time-title').textContent = `${byId<HTMLSelectElement>('gear-motion').selectedOptions[0]?.text ?? ''}${traces.title ? `: ${traces.title}` : ''}`;
    this.traces.show(traces, this.theme);
    this.gears.take(traces, this.theme);
    this.plots.set('time', positionsOverTime(traces, this.theme));
    this.addButtons('time');
  }

  // ---- maps and changes -------------------------------------------------------------------------

  private numbersOfDrive(): Parameter[] {
    return (this.facts?.parameters ?? []).filter((one) => one.kind === 'number' && typeof one.value === 'number' && one.value > 0);
  }

  private listAxes(): void {
    const usual = this.numbersOfDrive().filter((one) => one.is_usual || one.path.startsWith('servo.'));
    const paths = this.numbersOfDrive().map((one) => one.path);
    if (!paths.includes(this.state.x)) {
      const first = usual.find((one) => one.path === 'servo.inertia_ratio') ?? usual.find((one) => one.path.endsWith('backlash')) ?? usual[0];
      this.state.x = first?.path ?? paths[0] ?? '';
      const second = this.facts!.has_closed_form ? (usual.find((one) => one.path === 'servo.damping') ?? usual.find((one) => one.path !== this.state.x)) : undefined;
      this.state.y = second?.path ?? '';
    }
    if (!paths.includes(this.state.y)) this.state.y = '';
    for (const axis of ['x', 'y'] as const) {
      const list = byId<HTMLSelectElement>(`map-${axis}`);
      list.textContent = '';
      if (axis === 'y') list.add(new Option('nothing else', ''));
      for (const path of paths) list.add(new Option(path, path));
      list.value = this.state[axis];
    }
  }

  /** An axis as on the command line, over the slider's range. */
  private axisText(path: string, count: number): string {
    const parameter = this.facts!.parameters.find((one) => one.path === path)!;
    const slider = parameter.slider!;
    const unit = parameter.unit_in_si ?? 1;
    const words = parameter.unit ? ` ${parameter.unit}` : '';
    return `${path}=${typed(slider.low / unit)}${words}:${typed(slider.high / unit)}${words}:${count}${slider.logarithmic ? ':log' : ''}`;
  }

  private axes(): { ask: string; x: string; y?: string } {
    const isQuick = this.facts!.has_closed_form;
    const { x, y } = this.state;
    if (y && y !== x) return { ask: 'map', x: this.axisText(x, isQuick ? 41 : 7), y: this.axisText(y, isQuick ? 41 : 7) };
    return { ask: 'chart', x: this.axisText(x, isQuick ? 61 : 13) };
  }

  /** The map, unless the present one holds: the drive differs on its axes alone. */
  private async computeMap(turn = ++this.turn): Promise<void> {
    if (!this.state.x || !this.facts) return;
    const axes = this.axes();
    const drive = { ...this.state.drive, settings: this.state.drive.settings.filter(([path]) => path !== this.state.x && path !== this.state.y) };
    const key = JSON.stringify([drive, axes]);
    if (this.map?.key === key) return this.markHere();
    const words = byId('map-words');
    words.textContent = 'Computing …';
    document.querySelector('#card-map .picture')!.classList.add('stale');
    try {
      const replied = await this.thoroughly<MapReply | ChartReply>({ ...axes, drive, seconds: searchSeconds });
      if (turn !== this.turn) return;
      this.map = { replied: replied as Replied<MapReply>, key };
      const verb = axes.ask === 'map' ? `map --x '${axes.x}' --y '${axes.y}'` : `chart --x '${axes.x}'`;
      const kind = axes.ask === 'map' ? 'map=map.svg' : 'bifurcation=branches.svg';
      words.innerHTML = `${replied.reply.is_complete ? '' : 'Stopped before the end. '}<code>gearlash ${escapeText(verb)} ${escapeText(drive.name + setOptions(drive))} --plot ${kind}</code>`;
      this.markHere();
    } catch (error) {
      if (error instanceof Overtaken) words.textContent = 'Not computed for this drive.';
      else this.blank('map', wordsOf(error));
    }
  }

  /** Where the present drive is on the map, in its units. */
  private here(path: string, unit: number): number | null {
    const setting = this.state.drive.settings.find(([other]) => other === path)?.[1];
    const parameter = this.facts?.parameters.find((one) => one.path === path);
    if (!parameter || typeof parameter.value !== 'number') return null;
    const number = setting === undefined ? NaN : parseFloat(setting);
    const value = Number.isFinite(number) ? number * (parameter.unit_in_si ?? 1) : parameter.value;
    return value / unit;
  }

  private markHere(): void {
    if (!this.map || !this.answer) return;
    const { reply, numbers } = this.map.replied;
    document.querySelector('#card-map .picture')!.classList.remove('stale');
    if ('axes' in reply) {
      const x = this.here(reply.axes.x.path, reply.axes.x.unit_in_si);
      const y = this.here(reply.axes.y.path, reply.axes.y.unit_in_si);
      this.put('map', contourMap(reply, numbers, this.theme, x !== null && y !== null ? [x, y] : null));
      return;
    }
    const x = this.here(reply.x.path, reply.x.unit_in_si);
    const cycle = this.answer.reply.answer.cycles.find((one) => one.stability !== 'unstable');
    this.put('map', branchChart(reply, numbers, this.theme, x === null ? null : [x, (cycle?.amplitude ?? 0) / this.answer.reply.unit_in_si]));
  }

  private offerChanges(): void {
    byId('changes').textContent = '';
    byId('changes-words').textContent = 'For this drive each number needs its own search, seconds to minutes in all.';
    byId('changes-go').hidden = false;
  }

  /** The nearest change of each parameter that stops hunting, or starts it. */
  private async computeChanges(turn = ++this.turn): Promise<void> {
    if (!this.facts) return;
    const { drive } = this.state;
    byId('changes-go').hidden = true;
    const words = byId('changes-words');
    words.textContent = 'Searching …';
    const paths = (wanted: (one: Parameter) => boolean): string[] => this.numbersOfDrive().filter(wanted).map((one) => one.path);
    // A normal form's own numbers, a data sheet's as a designer changes them, else one search each.
    const requests = this.facts.is_normal_form
      ? [{ parameters: paths((one) => one.path !== 'servo.natural_frequency') }]
      : this.facts.has_closed_form
        ? [{}]
        : paths((one) => one.is_usual).map((path) => ({ parameters: [path] }));
    const rows: MarginsReply['texts'] = [];
    try {
      for (const [i, request] of requests.entries()) {
        if (requests.length > 1) words.textContent = `Searching: ${i + 1} of ${requests.length} numbers …`;
        const { reply } = await this.thoroughly<MarginsReply>({ ask: 'margins', drive, ...request, seconds: searchSeconds });
        if (turn !== this.turn) return;
        rows.push(...reply.texts);
        this.showChanges(reply.hunts, rows);
      }
    } catch (error) {
      words.textContent = error instanceof Overtaken ? 'Not searched for this drive.' : wordsOf(error);
      if (!(error instanceof Overtaken)) return;
      byId('changes-go').hidden = false;
    }
  }

  private showChanges(hunts: boolean, rows: MarginsReply['texts']): void {
    byId('changes-words').textContent = hunts ? 'It stops hunting where one number changes, all others as they are:' : 'It starts to hunt where one number changes, all others as they are:';
    const cell = (text: string | null | undefined): string => (text ? escapeText(text) : '–');
    byId('changes').innerHTML =
      `<table><thead><tr><th scope="col">number</th><th scope="col">now</th><th scope="col">down to</th><th scope="col">up to</th></tr></thead><tbody>` +
      rows
        .map((row) => `<tr><th scope="row" title="${escapeText(row.description)}">${escapeText(row.parameter)}</th><td>${cell(row.present)}</td><td>${this.changeCell(row, row.below)}</td><td>${this.changeCell(row, row.above)}</td></tr>`)
        .join('') +
      `</tbody></table>`;
    for (const button of byId('changes').querySelectorAll<HTMLButtonElement>('button')) {
      button.onclick = () => this.change(button.dataset.path!, button.dataset.text!, false);
    }
  }

  private changeCell(row: MarginsReply['texts'][0], text: string | null): string {
    if (!text || !row.is_setting) return escapeText(text ?? '–');
    return `<button type="button" data-path="${escapeText(row.parameter)}" data-text="${escapeText(text)}" title="Try it">${escapeText(text)}</button>`;
  }

  // ---- faults -----------------------------------------------------------------------------------

  private refuse(error: unknown): void {
    if (error instanceof Overtaken) return;
    if (error instanceof InputError) {
      this.showFaults(error.faults);
      return;
    }
    this.tell(wordsOf(error));
  }

  private showFaults(faults: Fault[]): void {
    const others = this.inputs.mark(faults);
    const place = byId('faults');
    place.textContent = '';
    if (faults.length === 0) return;
    if (others.length > 0) {
      place.innerHTML = '<p>The answer is that of the drive before. This one is not complete:</p>';
      place.append(missingInputs(others, (path, text) => this.change(path, text, false)));
    }
    const level = byId('level');
    level.className = 'coarse';
    level.textContent = 'The answer is of the last drive without faults.';
  }

  /** A sentence that is not about a value. */
  private tell(sentence: string): void {
    byId('faults').innerHTML = `<p>${escapeText(sentence)}</p>`;
    if (!this.answer) byId('headline').textContent = 'No answer yet';
  }

  // ---- pictures ---------------------------------------------------------------------------------

  private put(card: string, plot: Plot): void {
    this.plots.set(card, plot);
    document.querySelector(`#card-${card} .picture`)!.innerHTML = draw(plot, this.theme);
    this.addButtons(card);
  }

  private blank(card: string, why: string): void {
    this.plots.delete(card);
    const place = document.querySelector(`#card-${card} .picture`)!;
    place.classList.remove('stale');
    place.textContent = why;
    document.querySelector(`#card-${card} .buttons`)?.remove();
    if (card === 'map') byId('map-words').textContent = '';
  }

  private addButtons(card: string): void {
    const article = byId(`card-${card}`);
    if (article.querySelector('.buttons')) return;
    const line = document.createElement('p');
    line.className = 'buttons';
    const add = (name: string, does: () => void): void => {
      const button = document.createElement('button');
      button.type = 'button';
      button.textContent = name;
      button.setAttribute('aria-label', `${article.querySelector('h2')?.textContent ?? 'Figure'} as ${name}`);
      button.onclick = does;
      line.append(button);
    };
    const name = (): string => `${this.state.drive.name.replace(/\.toml$/, '')}-${card}`;
    add('SVG', () => save(`${name()}.svg`, svgFile(this.inPrint(card)), 'image/svg+xml'));
    add('PNG', () => void savePng(`${name()}.png`, this.inPrint(card)).catch((error) => this.tell(wordsOf(error))));
    add('CSV', () => save(`${name()}.csv`, this.dataOf(card), 'text/csv'));
    article.append(line);
  }

  /** The picture in the colours of paper. */
  private inPrint(card: string): Plot {
    const before = this.theme;
    this.theme = light;
    try {
      this.draw(card);
      return this.plots.get(card)!;
    } finally {
      this.theme = before;
      this.draw(card);
    }
  }

  private draw(card: string): void {
    if (card === 'phase') this.answer?.reply.phase && this.put('phase', phasePlane(this.answer.reply.phase, this.answer.numbers, this.theme));
    else if (card === 'map') this.markHere();
    else if (card === 'time') this.showMotion();
    else if (this.figure) this.put('figure', figurePlot(this.figure.reply, this.figure.numbers, this.theme));
  }

  private dataOf(card: string): string {
    if (card === 'time') {
      const t = this.chosenMotion()!;
      const header = ['time_s', `load_${t.unit}`, `motor_${t.unit}`, `reference_${t.unit}`, 'motor_torque_N_m'];
      const columns: ArrayLike<number>[] = [t.time, t.load, t.motor, t.reference, t.torque];
      if (t.encoder) {
        header.push(`encoder_${t.unit}`);
        columns.push(t.encoder);
      }
      return csv(header, columns);
    }
    return curvesOf(this.plots.get(card)!);
  }

  private redraw(): void {
    if (this.answer) {
      this.showPictures();
      this.markHere();
    }
    if (this.figure) this.draw('figure');
  }

  // ---- views ------------------------------------------------------------------------------------

  private async look(view: State['view']): Promise<void> {
    const wasInStory = this.state.view === 'story';
    this.state.view = view;
    if (view === 'explore' && wasInStory && !this.state.example) this.state.drive.name = 'story.toml';
    void this.keepAddress();
    await this.load();
  }

  private showView(): void {
    const { view } = this.state;
    document.body.classList.toggle('story', view === 'story');
    for (const button of document.querySelectorAll<HTMLButtonElement>('[data-view]')) {
      if (button.dataset.view === view) button.setAttribute('aria-current', 'page');
      else button.removeAttribute('aria-current');
    }
    byId('story').hidden = view !== 'story';
    byId('thesis').hidden = view !== 'thesis';
    byId('drive').hidden = view === 'thesis';
    byId('answer').hidden = view === 'thesis';
    const cards = view === 'story' ? this.story[this.state.step - 1]!.cards : null;
    for (const card of document.querySelectorAll<HTMLElement>('.cards article')) {
      card.hidden = cards !== null && !cards.includes(card.id.replace('card-', ''));
    }
  }

  private async toStep(step: number): Promise<void> {
    this.state.step = Math.max(1, Math.min(this.story.length, step));
    this.state.drive = this.story[this.state.step - 1]!.drive;
    this.state.example = '';
    this.state.x = this.state.y = '';
    await this.load();
    byId('story-title').focus();
  }

  private showStep(): void {
    const step = this.story[this.state.step - 1]!;
    byId('story-title').textContent = `${this.state.step}. ${step.title}`;
    byId('story-title').tabIndex = -1;
    byId('story-sentence').textContent = step.sentence;
    const list = byId('story-steps');
    list.textContent = '';
    this.story.forEach(({ title }, i) => {
      const item = document.createElement('li');
      const button = document.createElement('button');
      button.type = 'button';
      button.textContent = `${i + 1}. ${title}`;
      if (i + 1 === this.state.step) button.setAttribute('aria-current', 'step');
      button.onclick = () => void this.toStep(i + 1);
      item.append(button);
      list.append(item);
    });
    byId<HTMLButtonElement>('story-back').disabled = this.state.step === 1;
    byId<HTMLButtonElement>('story-next').disabled = this.state.step === this.story.length;
    const parameter = this.facts?.parameters.find((one) => one.path === step.path);
    const place = byId('story-input');
    place.textContent = '';
    if (parameter) singleInput(place, parameter, (path, text, isDragging) => this.change(path, text, isDragging));
  }

  private async showFigure(): Promise<void> {
    byId<HTMLSelectElement>('figure').value = String(this.state.figure);
    void this.keepAddress();
    try {
      this.figure = await this.core.thorough.ask<FigureReply>({ ask: 'thesis', figure: this.state.figure });
      this.draw('figure');
    } catch (error) {
      if (!(error instanceof Overtaken)) this.blank('figure', wordsOf(error));
    }
  }

  // ---- keeping ----------------------------------------------------------------------------------

  private lastAddress = '';

  private async keepAddress(): Promise<void> {
    const address = await addressOf(this.state);
    this.lastAddress = `#${address}`;
    history.replaceState(null, '', this.lastAddress);
  }

  /** A link was followed in this page, or its address edited. */
  private async follow(): Promise<void> {
    if (location.hash === this.lastAddress) return;
    try {
      this.state = await stateOf(location.hash, this.state, examples);
      await this.load();
    } catch (error) {
      this.tell(wordsOf(error));
    }
  }

  private showCommand(): void {
    byId<HTMLTextAreaElement>('command').value = commandOf(this.state.drive);
  }

  private async saveDrive(): Promise<void> {
    try {
      const { reply } = await this.core.quick.ask<{ toml: string }>({ ask: 'file', drive: this.state.drive });
      const name = this.state.drive.name.endsWith('.toml') ? this.state.drive.name : `${this.state.drive.name}.toml`;
      save(name, `# gearlash limit-cycle ${name}\n\n${reply.toml}`);
      byId('saved').textContent = `Saved ${name} with all its numbers. gearlash limit-cycle ${name} gives the same answer.`;
    } catch (error) {
      this.refuse(error);
    }
  }

  private async copyLink(): Promise<void> {
    await this.keepAddress();
    try {
      await navigator.clipboard.writeText(location.href);
      byId('saved').textContent = 'The link is copied: it holds the drive and this view.';
    } catch {
      byId('saved').textContent = 'The browser does not let the page copy. The link is in its address bar.';
    }
  }
}

// ---- words --------------------------------------------------------------------------------------

const capital = (text: string): string => text.charAt(0).toUpperCase() + text.slice(1);

const wordsOf = (error: unknown): string =>
  error instanceof InputError ? error.faults.map((fault) => `${fault.path} = ${fault.value} ${fault.permitted}`).join('; ') : error instanceof Error ? error.message : String(error);

function ceilingText(reply: AnswerReply): string {
  const { ceiling } = reply.answer;
  if (!ceiling) return '';
  if (ceiling.value === null) return `No ceiling: ${ceiling.reason ?? 'none is proved'}.`;
  return `Ceiling, proved: the load swings by at most ±${short(roundedUp(ceiling.value / reply.unit_in_si))} ${reply.unit}, whatever happens in the gap.`;
}

/** A bound is rounded up. */
function roundedUp(bound: number): number {
  const shown = Number(bound.toPrecision(4));
  if (shown >= bound || bound <= 0) return shown;
  return Number((shown + 10 ** (Math.floor(Math.log10(bound)) - 3)).toPrecision(4));
}

function levelText(reply: AnswerReply): string {
  const found = {
    'closed form': 'computed in closed form',
    'proof by energy': 'proved by energy, without following a motion',
    followed: 'followed from the answer before',
    'one start': 'by following one motion',
    search: 'searched from many starts',
  }[reply.means];
  if (reply.level === 'coarse') return `Coarse, while you change it: ${found}.`;
  const certainty = reply.answer.certainty === 'theorem' || reply.answer.certainty === 'enclosed' ? ', and proved' : '';
  return `Fine: ${found}${certainty}.${reply.is_complete ? '' : ' The search was stopped before its end.'}`;
}

/** The curves of a picture as a table: number of the curve, x, y. */
function curvesOf(plot: Plot): string {
  const numbers: number[] = [];
  const x: number[] = [];
  const y: number[] = [];
  let curve = 0;
  for (const layer of plot.layers) {
    if (layer.kind !== 'line' && layer.kind !== 'marks') continue;
    if (layer.kind === 'line' && layer.fill) continue;
    ++curve;
    for (let i = 0; i + 1 < layer.points.length; i += 2) {
      if (!Number.isFinite(layer.points[i]!)) continue;
      numbers.push(curve);
      x.push(layer.points[i]!);
      y.push(layer.points[i + 1]!);
    }
  }
  const named = (label: string): string => `"${label.replaceAll('"', "'")}"`;
  return csv(['curve', named(plot.x.label), named(plot.y.label)], [numbers, x, y]);
}

/** Pages from a file or in a private window may have no storage. */
function localStorageItem(name: string): string | null {
  try {
    return localStorage.getItem(`gearlash-${name}`);
  } catch {
    return null;
  }
}
function keepItem(name: string, value: string): void {
  try {
    localStorage.setItem(`gearlash-${name}`, value);
  } catch {
    // kept for this visit alone
  }
}

const wasm = compiledCore();
wasm.catch((error: unknown) => {
  byId('headline').textContent = 'The core did not load';
  byId('faults').innerHTML = `<p>The numerical core of this page could not be loaded (${escapeText(String((error as Error).message ?? error))}). Reload the page; it needs WebAssembly with exceptions and vectors, as browsers have it since 2023.</p>`;
});
const explorer = new Explorer(new Core(startWorker, wasm));
wasm.then(() => explorer.start()).catch(() => {});
