// The inputs of a drive, made from the registry of parameters that the core sends.
import { addButton, made } from './elements';
import { escapeText, inWords, typed } from './numbers';
import type { DriveReply, Fault, Parameter, Slider } from './replies';

/** Steps of a slider; arrow keys move by one, page keys by ten. */
const steps = 400;

const titles: Record<string, string> = {
  servo: 'Normal form', motor: 'Motor', gearbox: 'Gearbox', load: 'Load', loop: 'Loop', contact: 'Contact', sensor: 'Sensor',
  controller: 'Controller', sampling: 'Sampling', reference: 'Reference', load_torque: 'Load torque',
};

/** The name of a section of a drive. */
export const titleOf = (section: string): string => titles[section] ?? inWords(section);

const toPosition = (value: number, slider: Slider): number =>
  slider.is_logarithmic
    ? Math.log(value / slider.low) / Math.log(slider.high / slider.low)
    : (value - slider.low) / (slider.high - slider.low);

const toValue = (position: number, slider: Slider): number =>
  slider.is_logarithmic ? slider.low * (slider.high / slider.low) ** position : slider.low + position * (slider.high - slider.low);

/** The number with its unit, as the core reads it. */
const settingOf = (value: number, parameter: Parameter): string => {
  const number = typed(value / (parameter.unit_in_si ?? 1));
  return parameter.unit ? `${number} ${parameter.unit}` : number;
};

function shownText(parameter: Parameter): string {
  const { value } = parameter;
  if (value === null) return '';
  if (typeof value !== 'number') return typeof value === 'string' ? value : JSON.stringify(value);
  return typed(value / (parameter.unit_in_si ?? 1), 7) + (parameter.unit ? ` ${parameter.unit}` : '');
}

export type Changed = (path: string, text: string, isDragging: boolean) => void;

interface Row {
  parameter: Parameter;
  field: HTMLInputElement | HTMLSelectElement;
  slider: HTMLInputElement | null;
  fault: HTMLElement;
  /** Where the slider runs: that of the drive as it was loaded, wider where a value needs it. */
  range: Slider | null;
}

export class Inputs {
  private readonly rows = new Map<string, Row>();
  private shape = '';

  constructor(
    private readonly place: HTMLElement,
    private readonly changed: Changed,
    /** Begins the ids of the fields; a page with two lists of inputs needs two. */
    private readonly prefix = 'field',
  ) {}

  /** Shows the drive. Where it has the same parameters as before only their values change. */
  show(drive: DriveReply): void {
    const shape = JSON.stringify(drive.parameters.map(({ path, kind }) => [path, kind]));
    const focused = this.place.contains(document.activeElement) ? document.activeElement!.id : '';
    if (shape !== this.shape) this.make(drive);
    this.shape = shape;
    for (const parameter of drive.parameters) this.update(parameter);
    if (focused && document.activeElement?.id !== focused) document.getElementById(focused)?.focus();
  }

  /** Forgets the ranges of the sliders: another drive is loaded. */
  reset(): void {
    this.shape = '';
  }

  /** Marks the fields at fault; returns the faults that no field shows. */
  mark(faults: Fault[]): Fault[] {
    for (const row of this.rows.values()) {
      row.fault.textContent = '';
      row.field.removeAttribute('aria-invalid');
    }
    return faults.filter((fault) => {
      const row = this.rows.get(fault.path);
      if (!row) return true;
      row.fault.textContent = `${fault.value ? `${fault.value} ` : ''}${fault.permitted}`;
      row.field.setAttribute('aria-invalid', 'true');
      return false;
    });
  }

  private make(drive: DriveReply): void {
    const open = new Set(Array.from(this.place.querySelectorAll<HTMLDetailsElement>('details[open]'), (d) => d.dataset.section));
    this.place.textContent = '';
    this.rows.clear();
    const sections = new Map<string, Parameter[]>();
    for (const parameter of drive.parameters) {
      const section = parameter.path.split('.')[0]!;
      sections.set(section, [...(sections.get(section) ?? []), parameter]);
    }
    for (const [section, parameters] of sections) {
      const list = (name: string, title: string, isOpen: boolean, rows: Parameter[]): HTMLDetailsElement => {
        const details = made('details', { open: open.has(name) || isOpen, innerHTML: `<summary>${escapeText(title)}</summary>` });
        details.dataset.section = name;
        details.append(...rows.map((parameter) => this.row(parameter)));
        return details;
      };
      const [given, rest] = [parameters.filter((p) => !p.is_default || p.is_usual), parameters.filter((p) => p.is_default && !p.is_usual)];
      const details = list(section, titleOf(section), parameters.some((parameter) => parameter.is_usual), given);
      if (rest.length > 0) {
        const more = list(`${section}.more`, `${given.length > 0 ? 'more' : 'all'} (${rest.length})`, false, rest);
        more.className = 'more';
        details.append(more);
      }
      this.place.append(details);
    }
    if (drive.absent.length > 0 && !drive.is_normal_form) this.place.append(this.absent(drive, sections));
  }

  /** Sections that the drive lacks are added by a key of theirs. */
  private absent(drive: DriveReply, sections: Map<string, Parameter[]>): HTMLElement {
    const line = made('p', { className: 'absent' });
    line.innerHTML = `Not in this drive: ${drive.absent.filter(({ name }) => name !== 'servo').map(({ name, contents }) => `<span title="${escapeText(contents)}">${escapeText(titleOf(name))}</span>`).join(', ')}. `;
    if (drive.absent.some(({ name }) => name === 'sampling') && sections.has('controller')) {
      addButton(line, 'Sample the controller', () => this.changed('sampling.period', '1 ms', false));
    }
    return line;
  }

  private row(parameter: Parameter): HTMLElement {
    const row = made('div', { className: `row ${parameter.kind}` });
    const id = `${this.prefix}-${parameter.path.replace(/[^\w]/g, '-')}`;
    const fault = made('p', { className: 'fault', id: `${id}-fault` });
    row.innerHTML = `<label for="${id}">${escapeText(inWords(parameter.path))}</label>`;
    const isWord = parameter.kind === 'choice';
    const field = made(isWord ? 'select' : 'input', { id, title: `${parameter.path}: ${parameter.meaning}` });
    field.setAttribute('aria-describedby', fault.id);
    if (field instanceof HTMLInputElement) {
      field.autocomplete = 'off';
      field.spellcheck = false;
      field.placeholder = parameter.is_required ? 'needed' : 'none';
    } else {
      for (const choice of parameter.choices ?? []) field.add(new Option(choice, choice));
    }
    field.onchange = () => this.typedInto(parameter.path);
    row.append(field);
    let slider: HTMLInputElement | null = null;
    if (parameter.kind === 'number' && typeof parameter.value === 'number') {
      slider = this.slider(parameter);
      row.append(slider);
    }
    row.append(fault);
    this.rows.set(parameter.path, { parameter, field, slider, fault, range: parameter.slider ?? null });
    return row;
  }

  private slider(parameter: Parameter): HTMLInputElement {
    const slider = made('input', {
      type: 'range', min: '0', max: String(steps), step: '1',
      oninput: () => this.dragged(parameter.path, true),
      onchange: () => this.dragged(parameter.path, false),
    });
    slider.setAttribute('aria-label', `${inWords(parameter.path)}, slider`);
    return slider;
  }

  private dragged(path: string, isDragging: boolean): void {
    const row = this.rows.get(path)!;
    const value = toValue(Number(row.slider!.value) / steps, row.range!);
    const text = settingOf(value, row.parameter);
    row.field.value = text;
    row.slider!.setAttribute('aria-valuetext', text);
    this.changed(path, text, isDragging);
  }

  private typedInto(path: string): void {
    const row = this.rows.get(path)!;
    const text = row.field.value.trim();
    const isBare = row.parameter.kind === 'number' && row.parameter.unit && Number.isFinite(Number(text)) && text !== '';
    this.changed(path, text === '' ? 'none' : isBare && Number(text) !== 0 ? `${text} ${row.parameter.unit}` : text, false);
  }

  private update(parameter: Parameter): void {
    const row = this.rows.get(parameter.path);
    if (!row) return;
    row.parameter = parameter;
    if (document.activeElement !== row.field) row.field.value = shownText(parameter);
    if (row.slider) row.slider.disabled = typeof parameter.value !== 'number';
    if (!row.slider || typeof parameter.value !== 'number') return;
    const range = row.range!;
    if (parameter.value < range.low || parameter.value > range.high) row.range = parameter.slider!;
    row.slider.setAttribute('aria-valuetext', shownText(parameter));
    const position = toPosition(parameter.value, row.range!);
    if (document.activeElement !== row.slider) row.slider.value = String(Math.round(steps * position));
  }
}

/** The inputs of faults that belong to no field: values that a drive still needs. */
export function missingInputs(faults: Fault[], changed: Changed): HTMLElement {
  const list = made('ul');
  for (const fault of faults) {
    const item = made('li');
    const what = fault.value ? `${fault.path} = ${fault.value}` : fault.path;
    item.innerHTML = `<span><b>${escapeText(what)}</b> ${escapeText(fault.permitted)}${fault.where ? ` <small>(${escapeText(fault.where)})</small>` : ''}</span> `;
    const field = made('input', { placeholder: 'number unit' });
    field.setAttribute('aria-label', fault.path);
    field.onchange = () => field.value.trim() && changed(fault.path, field.value.trim(), false);
    item.append(field);
    list.append(item);
  }
  return list;
}

/** A reply with one parameter alone, for the story. */
export const only = (parameter: Parameter): DriveReply => ({
  parameters: [{ ...parameter, is_usual: true }], absent: [], is_normal_form: true, is_searched: false,
});
