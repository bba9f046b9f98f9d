// What takes longer than an answer: the map or chart with the border of hunting, and the nearest
// changes.
import type { Cards } from './cards';
import { type Lane, Overtaken, patiently } from './core';
import { byId } from './elements';
import { titleOf } from './inputs';
import { escapeText, inWords, typed } from './numbers';
import { plotOf } from './pictures';
import type { AnswerReply, DriveReply, DriveText, MarginsReply, Parameter, PictureReply, Replied } from './replies';
import { quoted, setOptions } from './state';
import { wordsOf } from './words';

/** What the studies need of the page. */
interface Page {
  drive(): DriveText;
  facts(): DriveReply;
  answer(): AnswerReply | null;
  /** The axes that were chosen: paths, the second may be ''. */
  axes(): { x: string; y: string };
  change(path: string, text: string): void;
}

/** A picture over parameters. */
interface Request {
  kind: string;
  x: string;
  y?: string;
}

/** Points on each axis: a closed form is solved at once, a search takes a second. */
const pointsOf = { map: { closed: 41, searched: 7 }, chart: { closed: 61, searched: 13 } };
const seconds = 120;

/** Fills a list with the parameters by section, after `none`. */
function listPaths(list: HTMLSelectElement, paths: string[], chosen: string, none?: string): void {
  list.textContent = '';
  if (none) list.add(new Option(none, ''));
  let group: HTMLOptGroupElement | null = null;
  for (const path of paths) {
    const label = titleOf(path.split('.')[0]!);
    if (group?.label !== label) {
      group = document.createElement('optgroup');
      group.label = label;
      list.append(group);
    }
    group.append(new Option(inWords(path), path));
  }
  list.value = chosen;
}

/** Lists the axes that the drive can have; gives the chosen ones, or the most telling if it lacks these. */
export function listAxes(facts: DriveReply, chosen: { x: string; y: string }): { x: string; y: string } {
  const numbers = facts.parameters.filter((one) => one.kind === 'number' && typeof one.value === 'number' && one.value > 0);
  const usual = numbers.filter((one) => one.is_usual || one.path.startsWith('servo.')).map((one) => one.path);
  const paths = numbers.map((one) => one.path);
  let { x, y } = chosen;
  if (!paths.includes(x)) {
    x = usual.find((path) => path === 'servo.inertia_ratio') ?? usual.find((path) => path.endsWith('backlash')) ?? usual[0] ?? paths[0] ?? '';
    y = facts.is_searched ? '' : (usual.find((path) => path === 'servo.damping') ?? usual.find((path) => path !== x) ?? '');
  }
  if (!paths.includes(y)) y = '';
  listPaths(byId<HTMLSelectElement>('map-x'), paths, x);
  listPaths(byId<HTMLSelectElement>('map-y'), paths, y, 'nothing else');
  return { x, y };
}

export class Studies {
  private map: { replied: Replied<PictureReply>; key: string } | null = null;
  /** The map that is on the page with a mark, which can be moved. */
  private drawn: object | null = null;
  private job = 0;

  constructor(
    private readonly page: Page,
    private readonly lane: Lane,
    private readonly cards: Cards,
  ) {}

  /** Another drive is loaded. */
  forget(): void {
    this.map = this.drawn = null;
    ++this.job;
    this.lane.giveUp();
    for (const name of ['map', 'more']) this.cards.blank(name, '');
    for (const id of ['map-words', 'more-words']) byId(id).textContent = '';
    byId('changes').textContent = '';
    byId('changes-words').textContent = '';
    byId('changes-go').hidden = true;
  }

  giveUp(): void {
    this.lane.giveUp();
  }

  // ---- the map ----------------------------------------------------------------------------------

  /** An axis as on the command line, over the slider's range. */
  private axisText(path: string, count: number): string {
    const parameter = this.page.facts().parameters.find((one) => one.path === path);
    if (!parameter?.slider) return path;
    const { slider } = parameter;
    const unit = parameter.unit_in_si ?? 1;
    const words = parameter.unit ? ` ${parameter.unit}` : '';
    return `${path}=${typed(slider.low / unit)}${words}:${typed(slider.high / unit)}${words}:${count}${slider.is_logarithmic ? ':log' : ''}`;
  }

  private request(): Request {
    const engine = this.page.facts().is_searched ? 'searched' : 'closed';
    const { x, y } = this.page.axes();
    if (y && y !== x) return { kind: 'map', x: this.axisText(x, pointsOf.map[engine]), y: this.axisText(y, pointsOf.map[engine]) };
    return { kind: 'bifurcation', x: this.axisText(x, pointsOf.chart[engine]) };
  }

  /** Computes the map, unless the present one holds: the drive differs on its axes alone. */
  async drawMap(): Promise<void> {
    const { x, y } = this.page.axes();
    if (!x) return;
    const present = this.page.drive();
    const drive = { ...present, settings: present.settings.filter(([path]) => path !== x && path !== y) };
    const request = this.keptAxes(drive) ?? this.request();
    const key = JSON.stringify([drive, request]);
    if (this.map?.key === key) return this.markHere();
    this.lane.giveUp();
    const job = ++this.job;
    const words = byId('map-words');
    words.textContent = 'Computing …';
    this.cards.fade('map');
    try {
      const replied = await patiently<PictureReply>(this.lane, { ask: 'picture', ...request, drive: present, seconds });
      if (job !== this.job) return;
      this.map = { replied, key };
      words.innerHTML = this.commandText(request, drive, replied.reply.is_complete);
      this.markHere();
    } catch (error) {
      if (job !== this.job) return;
      words.textContent = error instanceof Overtaken ? 'Not computed for this drive.' : '';
      if (!(error instanceof Overtaken)) this.cards.blank('map', wordsOf(error));
    }
  }

  /** The request of the present map if it is of this drive and these axes: sliders that were widened since do not change it. */
  private keptAxes(drive: DriveText): Request | null {
    if (!this.map) return null;
    const [before, request] = JSON.parse(this.map.key) as [DriveText, Request];
    const path = (axis: string | undefined): string => (axis ?? '').split('=')[0]!;
    const { x, y } = this.page.axes();
    const isSame = JSON.stringify(before) === JSON.stringify(drive) && path(request.x) === x && path(request.y) === (y === x ? '' : y);
    return isSame ? request : null;
  }

  private commandText(request: Request, drive: DriveText, isComplete: boolean): string {
    const axes = request.y ? `map --x '${request.x}' --y '${request.y}'` : `chart --x '${request.x}'`;
    const plot = request.y ? 'map=map.svg' : 'bifurcation=branches.svg';
    const stopped = isComplete ? '' : 'Stopped before the end. ';
    return `${stopped}<code>gearlash ${escapeText(axes)} ${escapeText(quoted(drive.name) + setOptions(drive))} --plot ${plot}</code>`;
  }

  /** Where the present drive is on an axis, in its unit. While a slider moves, its text is newer than the facts. */
  private here(path: string, unit: number): number | null {
    const parameter = this.page.facts().parameters.find((one) => one.path === path);
    if (!parameter || typeof parameter.value !== 'number') return null;
    const text = this.page.drive().settings.find(([other]) => other === path)?.[1];
    const [, number, unitText] = /^\s*(-?[\d.eE+-]+)\s*(.*)$/.exec(text ?? '') ?? [];
    const isKnown = number !== undefined && (unitText ?? '').trim() === (parameter.unit ?? '');
    return (isKnown ? Number(number) * (parameter.unit_in_si ?? 1) : parameter.value) / unit;
  }

  /** Draws the map with the mark of the present drive. */
  markHere(): void {
    const answer = this.page.answer();
    if (!this.map || !answer) return;
    const { reply, numbers } = this.map.replied;
    const cycle = answer.answer.cycles.find((one) => one.stability !== 'unstable');
    const x = reply.x && this.here(reply.x.path, reply.x.unit_in_si);
    const y = reply.y ? this.here(reply.y.path, reply.y.unit_in_si) : (cycle?.amplitude ?? 0) / answer.unit_in_si;
    const place = x !== null && y !== null ? { x, y } : null;
    if (place && this.drawn === this.map) return this.cards.move('map', place);
    this.cards.put('map', plotOf(reply.plot, numbers, place));
    this.drawn = place && this.map;
  }

  // ---- other pictures ---------------------------------------------------------------------------

  /** The chosen picture of the present drive. */
  async drawMore(): Promise<void> {
    const drive = this.page.drive();
    const kind = byId<HTMLSelectElement>('more-kind').value;
    const words = byId('more-words');
    const axis = kind === 'curves' ? { x: this.axisText(this.page.axes().x, pointsOf.chart[this.page.facts().is_searched ? 'searched' : 'closed']) } : {};
    words.textContent = 'Computing …';
    this.cards.fade('more');
    try {
      const { reply, numbers } = await patiently<PictureReply>(this.lane, { ask: 'picture', kind, drive, ...axis, seconds });
      if (drive !== this.page.drive()) return;
      words.textContent = [reply.plot.title, ...reply.plot.subtitles].join('; ');
      this.cards.put('more', plotOf(reply.plot, numbers));
    } catch (error) {
      if (drive !== this.page.drive()) return;
      words.textContent = error instanceof Overtaken ? 'Not computed for this drive.' : '';
      if (!(error instanceof Overtaken)) this.cards.blank('more', wordsOf(error));
    }
  }

  // ---- changes ----------------------------------------------------------------------------------

  offerChanges(): void {
    byId('changes').textContent = '';
    byId('changes-words').textContent = 'For this drive each number needs a search of its own, seconds to minutes in all.';
    byId('changes-go').hidden = false;
  }

  /** A normal form's own numbers, a data sheet's as a designer changes them, else one search for each, and for the sensor's place. */
  private marginRequests(): object[] {
    const facts = this.page.facts();
    const paths = (wanted: (one: Parameter) => boolean): string[] => facts.parameters.filter(wanted).map((one) => one.path);
    const isAbove0 = (one: Parameter): boolean => one.kind === 'number' && typeof one.value === 'number' && one.value > 0;
    if (facts.is_normal_form) return [{ parameters: paths((one) => isAbove0(one) && one.path !== 'servo.natural_frequency') }];
    if (!facts.is_searched) return [{}];
    return paths((one) => (isAbove0(one) && one.is_usual) || one.path === 'sensor.position').map((path) => ({ parameters: [path] }));
  }

  /** The nearest change of each parameter that stops hunting, or starts it. */
  async searchChanges(): Promise<void> {
    const drive = this.page.drive();
    const words = byId('changes-words');
    byId('changes-go').hidden = true;
    words.textContent = 'Searching …';
    const requests = this.marginRequests();
    const rows: MarginsReply['texts'] = [];
    try {
      for (const [i, request] of requests.entries()) {
        if (requests.length > 1) words.textContent = `Searching: ${i + 1} of ${requests.length} numbers …`;
        const { reply } = await patiently<MarginsReply>(this.lane, { ask: 'margins', drive, ...request, seconds });
        if (drive !== this.page.drive()) return;
        rows.push(...reply.texts);
        this.showChanges(reply, rows);
      }
    } catch (error) {
      if (drive !== this.page.drive()) return;
      words.textContent = error instanceof Overtaken ? 'Not searched for this drive.' : wordsOf(error);
      byId('changes-go').hidden = false;
    }
  }

  private showChanges({ hunts, is_known, is_complete }: MarginsReply, rows: MarginsReply['texts']): void {
    byId('card-changes').classList.remove('old');
    const what = !is_known ? 'It is known to come to rest' : hunts ? 'It stops hunting' : 'It starts to hunt';
    const certainty = rows.every((row) => row.is_certified) ? 'Proved: no nearer value exists.' : 'Searched, not proved.';
    byId('changes-words').textContent = `${what} where one number changes, all others as they are. ${certainty}${is_complete ? '' : ' Stopped before the end.'}`;
    const heads = ['number', 'now', 'down to', 'up to'].map((head) => `<th scope="col">${head}</th>`).join('');
    const lines = rows.map(
      (row) =>
        `<tr><th scope="row" title="${escapeText(`${row.parameter}: ${row.description}`)}">${escapeText(row.parameter.replace(/[._]/g, ' '))}</th><td>${escapeText(row.present ?? '')}</td>` +
        (row.below || row.above
          ? `<td>${this.changeCell(row, row.below)}</td><td>${this.changeCell(row, row.above)}</td></tr>`
          : `<td colspan="2">${row.choices.map((choice) => this.changeCell(row, choice)).join(' ') || escapeText(`nowhere from ${row.searched}`)}</td></tr>`),
    );
    byId('changes').innerHTML = `<table><thead><tr>${heads}</tr></thead><tbody>${lines.join('')}</tbody></table>`;
    for (const button of byId('changes').querySelectorAll<HTMLButtonElement>('button')) {
      button.onclick = () => this.page.change(button.dataset.path!, button.dataset.text!);
    }
  }

  private changeCell(row: MarginsReply['texts'][0], text: string | null): string {
    if (!text || !row.is_setting) return escapeText(text ?? '–');
    return `<button type="button" data-path="${escapeText(row.parameter)}" data-text="${escapeText(text)}" title="Try it">${escapeText(text)}</button>`;
  }
}
