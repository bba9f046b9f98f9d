// The explorer: holds the state, asks the core, and shows the answers.
import './style.css';

import { Cards } from './cards';
import { type Core, InputError, Lane, Overtaken, patiently } from './core';
import { byId, markCurrent } from './elements';
import { aboutOf, examples, listExamples, markExample, offerOwn } from './examples';
import { Inputs, missingInputs } from './inputs';
import { driveIn, listenToFiles } from './opening';
import { embeddedDrive, loadedParts } from './parts';
import { copyLink, keepTheme, keptTheme, saveDrive } from './keeping';
import { Motions } from './motions';
import type { AnswerReply, DriveReply, DriveText, Fault, Replied } from './replies';
import { addressOf, commandOf, setOptions, stateOf, withSetting, type State } from './state';
import { Story, storySteps } from './story';
import { listAxes, Studies } from './studies';
import { Thesis } from './thesis';
import { capital, ceilingText, growthText, levelText, wordsOf } from './words';

/** Milliseconds without a change after which a slider rests. */
const restAfter = 220;
/** Seconds after which a search ends with what is known by then. */
const searchSeconds = 120;

class Explorer {
  private state!: State;
  private facts: DriveReply | null = null;
  private answer: Replied<AnswerReply> | null = null;
  private resting: ReturnType<typeof setTimeout> | undefined;
  private isAsking = false;
  private isStale = false;
  /** Whether the fine answer is on its way. */
  private isSearching = false;
  /** Whether the faults of the drive are values that can be typed. */
  private isCompletable = false;
  /** What was explored before the story. */
  private explored: Pick<State, 'drive' | 'example' | 'x' | 'y'> | null = null;
  /** Counts what the user did; an answer to older input is dropped. */
  private turn = 0;
  private readonly cards = new Cards(() => this.state.drive.name.replace(/\.toml$/, ''), (error) => this.tell(wordsOf(error)));
  private readonly studies: Studies;
  private readonly inputs = new Inputs(byId('inputs'), (path, text, isDragging) => this.change(path, text, isDragging));
  private readonly motions: Motions;
  private readonly story = new Story(storySteps(examples.get('first-servo')!), (step) => void this.toStep(step), (path, text, isDragging) => this.change(path, text, isDragging));
  private readonly thesis: Thesis;

  constructor(private readonly core: Core) {
    this.motions = new Motions(this.cards);
    this.studies = new Studies(
      {
        drive: () => this.state.drive,
        facts: () => this.facts!,
        answer: () => this.answer?.reply ?? null,
        axes: () => this.state,
        change: (path, text) => this.change(path, text, false),
      },
      core.studies,
      this.cards,
    );
    this.thesis = new Thesis(core.studies, this.cards, (figure) => {
      this.state.figure = figure;
      void this.keepAddress();
      void this.thesis.show(figure);
    });
  }

  // ---- beginning --------------------------------------------------------------------------------

  async start(): Promise<void> {
    this.useTheme(keptTheme() ?? (matchMedia('(prefers-color-scheme: dark)').matches ? 'dark' : 'light'));
    listExamples(byId('examples'), (toml, name) => void this.take({ toml, name: `${name}.toml`, settings: [] }, name));
    this.listen();
    const own = embeddedDrive();
    const [first, toml] = examples.entries().next().value as [string, string];
    const start: State = {
      drive: own ?? { toml, name: `${first}.toml`, settings: [] }, example: own ? '' : first,
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

  private listen(): void {
    for (const button of document.querySelectorAll<HTMLButtonElement>('[data-view]')) {
      button.onclick = () => void this.look(button.dataset.view as State['view']);
    }
    byId('theme').onclick = () => {
      const name = document.documentElement.dataset.theme === 'light' ? 'dark' : 'light';
      this.useTheme(name);
      keepTheme(name);
    };
    byId('print').onclick = () => window.print();
    byId('stop').onclick = () => this.stop();
    byId('save-toml').onclick = () => void saveDrive(this.core.answers, this.state.drive).catch((error) => this.refuse(error));
    byId('copy-link').onclick = () => void this.keepAddress().then(copyLink);
    byId('map-go').onclick = () => void this.studies.drawMap();
    byId('more-go').onclick = () => void this.studies.drawMore();
    byId('changes-go').onclick = () => void this.studies.searchChanges();
    for (const axis of ['x', 'y'] as const) {
      byId<HTMLSelectElement>(`map-${axis}`).onchange = (event) => {
        this.state[axis] = (event.target as HTMLSelectElement).value;
        void this.keepAddress();
        void this.studies.drawMap();
      };
    }
    byId('story-back').onclick = () => void this.toStep(this.state.step - 1);
    byId('story-next').onclick = () => void this.toStep(this.state.step + 1);
    byId('story-take').onclick = () => void this.look('explore', false);
    window.addEventListener('hashchange', (event) => void this.follow(new URL(event.newURL).hash));
    listenToFiles(byId<HTMLInputElement>('file'), byId('dropping'), (list) => void this.open(list));
  }

  private useTheme(name: string): void {
    document.documentElement.dataset.theme = name;
    byId('theme').textContent = name === 'dark' ? 'Light' : 'Dark';
  }

  // ---- the drive --------------------------------------------------------------------------------

  private async open(list: FileList): Promise<void> {
    const drive = await driveIn(list, this.state.drive).catch((error: unknown) => `The file cannot be read: ${wordsOf(error)}`);
    if (typeof drive === 'string') this.tell(drive);
    else await this.take(drive, drive.toml === this.state.drive.toml ? this.state.example : '');
  }

  /** Another drive. It replaces the present one unless it is no drive at all. */
  private async take(drive: DriveText, example: string): Promise<void> {
    const before = { ...this.state };
    if (before.example === '' && before.view === 'explore') offerOwn(byId('examples'), before.drive, (own) => void this.take(own, ''));
    this.tell('');
    Object.assign(this.state, { drive, example, x: '', y: '' });
    this.state.view = 'explore';
    if ((await this.load()) || this.isCompletable) return;
    Object.assign(this.state, before);
    if (this.facts) await this.load();
  }

  /** Shows the state from the beginning. False if its drive has faults. */
  private async load(): Promise<boolean> {
    clearTimeout(this.resting);
    this.giveUp();
    this.showView();
    this.studies.forget();
    if (this.state.view === 'thesis') {
      void this.keepAddress();
      await this.thesis.show(this.state.figure);
      if (!this.facts) await this.readDrive();
      return true;
    }
    if (this.state.view === 'story') {
      const step = this.story.steps[this.state.step - 1]!;
      if (this.state.drive.toml !== step.drive.toml) Object.assign(this.state, { drive: step.drive, example: '', x: '', y: '' });
    }
    this.inputs.reset();
    if (!(await this.readDrive()) && !(await this.readWithoutSettings())) return false;
    this.answering();
    if (!this.answer) byId('headline').textContent = 'Searching …';
    this.rest();
    return true;
  }

  /** A link may have settings that its drive does not take. */
  private async readWithoutSettings(): Promise<boolean> {
    const refused = setOptions(this.state.drive);
    if (this.facts !== null || refused === '') return false;
    this.state.drive = { ...this.state.drive, settings: [] };
    if (!(await this.readDrive())) return false;
    this.tell(`The drive does not take what the link sets, so it is left out:${refused}`);
    return true;
  }

  private async readDrive(): Promise<boolean> {
    try {
      const { reply } = await this.core.answers.ask<DriveReply>({ ask: 'drive', drive: this.state.drive });
      this.facts = reply;
    } catch (error) {
      this.refuse(error);
      return false;
    }
    this.showFaults([]);
    this.inputs.show(this.facts);
    markExample(byId('examples'), this.state.example);
    byId('about').textContent = aboutOf(this.state.drive.toml) || this.state.drive.name;
    Object.assign(this.state, listAxes(this.facts, this.state));
    if (this.state.view === 'story') this.story.show(this.state.step, this.facts.parameters);
    this.showCommand();
    return true;
  }

  private change(path: string, text: string, isDragging: boolean): void {
    this.state.drive = withSetting(this.state.drive, path, text);
    this.tell('');
    const parameter = this.facts?.parameters.find((one) => one.path === path);
    this.giveUp();
    if (!isDragging) this.answering();
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
    const start = performance.now();
    void this.core.answers
      .ask<AnswerReply>({ ask: 'answer', level: 'coarse', drive, seconds: 5 })
      .then((replied) => {
        if (drive !== this.state.drive && drive.toml !== this.state.drive.toml) return; // another file
        this.showFaults([]);
        this.show(replied);
        performance.measure('coarse answer', { start }); // for benchmarks/web
      })
      .catch((error) => this.refuse(error))
      .finally(() => {
        this.isAsking = false;
        if (this.isStale) this.ask();
      });
  }

  /** After a moment without a change, and with the coarse answer: the fine one, and what takes longer. */
  private rest(): void {
    clearTimeout(this.resting);
    this.resting = setTimeout(() => {
      if (this.isAsking) this.rest();
      else void this.settle();
    }, restAfter);
  }

  private async settle(): Promise<void> {
    const turn = ++this.turn;
    const { drive } = this.state;
    void this.keepAddress();
    try {
      this.isSearching = true;
      const replied = await patiently<AnswerReply>(this.core.answers, { ask: 'answer', level: 'fine', drive, seconds: searchSeconds });
      this.isSearching = false;
      if (turn !== this.turn) return;
      const facts = await this.core.answers.ask<DriveReply>({ ask: 'drive', drive });
      if (turn !== this.turn) return;
      this.facts = facts.reply;
      this.showFaults([]);
      this.inputs.show(facts.reply);
      if (this.state.view === 'story') this.story.update(this.state.step, facts.reply.parameters);
      this.show(replied);
      byId('spoken').textContent = replied.reply.headline;
      document.title = `Gearlash: ${replied.reply.headline}`;
    } catch (error) {
      this.refuse(error);
      return;
    }
    const isQuick = !this.facts!.is_searched;
    const isInStory = this.state.view === 'story';
    const shows = (card: string): boolean => !isInStory || this.story.steps[this.state.step - 1]!.cards.includes(card);
    if (shows('map')) await this.studies.drawMap();
    if (turn !== this.turn || !shows('changes')) return;
    if (isQuick || isInStory) await this.studies.searchChanges();
    else this.studies.offerChanges();
  }

  /** The answer on the page is that of the drive before. */
  private answering(): void {
    byId('level').className = 'coarse';
    byId('level').textContent = 'Answering …';
  }

  /** Ends all that takes long. */
  private giveUp(): void {
    ++this.turn;
    this.studies.giveUp();
    if (this.isSearching) this.core.answers.giveUp();
    this.isSearching = false;
  }

  private stop(): void {
    if (this.isSearching) byId('level').textContent = 'The search for the fine answer was stopped. What is shown is older.';
    this.giveUp();
  }

  private show(replied: Replied<AnswerReply>): void {
    this.answer = replied;
    const { reply } = replied;
    byId('headline').textContent = capital(reply.headline);
    byId('ceiling').textContent = growthText(reply) + ceilingText(reply);
    const level = byId('level');
    level.className = reply.level;
    level.textContent = levelText(reply);
    byId('report').classList.toggle('old', reply.report === null);
    if (reply.report !== null) byId('report').textContent = reply.report;
    else byId('card-changes').classList.add('old');
    this.motions.show(replied);
    this.studies.markHere();
  }

  // ---- faults -----------------------------------------------------------------------------------

  private refuse(error: unknown): void {
    if (error instanceof Overtaken) return;
    this.isCompletable = error instanceof InputError && error.faults.every((fault) => fault.is_parameter);
    if (this.isCompletable) this.showFaults((error as InputError).faults);
    else this.tell(wordsOf(error));
  }

  private showFaults(faults: Fault[]): void {
    const others = this.state.view === 'story' ? this.story.mark(faults) : this.inputs.mark(faults);
    const place = byId('faults');
    place.textContent = '';
    if (faults.length === 0) return;
    if (others.length > 0) {
      place.innerHTML = '<p>This drive is not complete, or not permitted:</p>';
      place.append(missingInputs(others, (path, text) => this.change(path, text, false)));
    }
    const level = byId('level');
    level.className = 'coarse';
    level.textContent = 'The answer is of the last drive without faults.';
  }

  /** A sentence that is not about a value; it stays until the next change. */
  private tell(sentence: string): void {
    byId('message').textContent = sentence;
    const isLoading = byId('headline').textContent?.startsWith('Loading');
    if (sentence && isLoading) byId('headline').textContent = 'No answer yet';
  }

  // ---- views ------------------------------------------------------------------------------------

  /** `returns`: to the drive that was explored before the story. */
  private async look(view: State['view'], returns = true): Promise<void> {
    const { drive, example, x, y } = this.state;
    if (this.state.view === 'story' && view !== 'story' && returns) Object.assign(this.state, this.explored ?? {});
    if (this.state.view !== 'story' && view === 'story') this.explored = { drive, example, x, y };
    this.state.view = view;
    void this.keepAddress();
    await this.load();
  }

  private showView(): void {
    const { view } = this.state;
    document.body.classList.toggle('story', view === 'story');
    markCurrent(document.querySelectorAll('[data-view]'), ({ dataset }) => dataset.view === view, 'page');
    byId('story').hidden = view !== 'story';
    byId('thesis').hidden = view !== 'thesis';
    byId('drive').hidden = view === 'thesis';
    byId('answer').hidden = view === 'thesis';
    const cards = view === 'story' ? this.story.steps[this.state.step - 1]!.cards : null;
    for (const card of document.querySelectorAll<HTMLElement>('.cards article')) {
      card.hidden = cards !== null && !cards.includes(card.id.replace('card-', ''));
    }
  }

  private async toStep(step: number): Promise<void> {
    this.state.step = Math.max(1, Math.min(this.story.steps.length, step));
    this.state.drive = this.story.steps[this.state.step - 1]!.drive;
    this.state.example = '';
    this.state.x = this.state.y = '';
    await this.load();
    byId('story-title').focus();
  }

  // ---- keeping ----------------------------------------------------------------------------------

  private lastAddress = '';

  private async keepAddress(): Promise<void> {
    const address = await addressOf(this.state);
    this.lastAddress = `#${address}`;
    history.replaceState(null, '', this.lastAddress);
  }

  /** A link was followed in this page, or its address edited. The address may by now be another: that of the drive before, kept in between. */
  private async follow(address: string): Promise<void> {
    if (address === this.lastAddress) return;
    try {
      this.state = await stateOf(address, this.state, examples);
      await this.load();
    } catch (error) {
      this.tell(wordsOf(error));
    }
  }

  private showCommand(): void {
    byId<HTMLTextAreaElement>('command').value = commandOf(this.state.drive);
  }
}

const parts = loadedParts();
parts.catch(() => {
  byId('headline').textContent = 'The core did not load';
});
const explorer = new Explorer({ answers: new Lane(parts), studies: new Lane(parts) });
void explorer.start();
