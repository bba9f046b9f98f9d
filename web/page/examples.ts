// The examples of the project, as the page has them.
import antenna from '../../examples/antenna-field-controlled.toml';
import camera from '../../examples/camera-head.toml';
import dynamixel from '../../examples/dynamixel-joint.toml';
import elinco from '../../examples/elinco-fd162.toml';
import firstServo from '../../examples/first-servo.toml';
import instrument from '../../examples/instrument-two-phase.toml';
import normalized from '../../examples/normalized.toml';
import faulhaber from '../../examples/products/faulhaber-1524-16-7.toml';
import harmonic from '../../examples/products/harmonic-drive-csg-25-100.toml';
import maxon from '../../examples/products/maxon-re40-gp42c.toml';
import tMotor from '../../examples/products/t-motor-ak80-6.toml';
import robot from '../../examples/robot-joint.toml';
import telescope from '../../examples/telescope-axis.toml';
import { addButton, markCurrent } from './elements';
import type { DriveText } from './replies';

/** Texts by name. The first is shown to a stranger. */
export const examples = new Map<string, string>([
  ['normalized', normalized],
  ['first-servo', firstServo],
  ['elinco-fd162', elinco],
  ['robot-joint', robot],
  ['telescope-axis', telescope],
  ['camera-head', camera],
  ['dynamixel-joint', dynamixel],
  ['antenna-field-controlled', antenna],
  ['instrument-two-phase', instrument],
  ['maxon-re40-gp42c', maxon],
  ['faulhaber-1524-16-7', faulhaber],
  ['harmonic-drive-csg-25-100', harmonic],
  ['t-motor-ak80-6', tMotor],
]);

/** The first sentence of the file's first comment. */
export function aboutOf(toml: string): string {
  const lines: string[] = [];
  for (const line of toml.split('\n')) {
    if (!line.startsWith('#')) break;
    lines.push(line.slice(1).trim());
  }
  return (/^.*?[^A-Z][.:](?= |$)/.exec(lines.join(' '))?.[0] ?? lines.join(' ')).replace(/[.:]$/, '');
}

/** One button for each example. */
export function listExamples(place: HTMLElement, chosen: (toml: string, name: string) => void): void {
  for (const [name, toml] of examples) {
    const button = addButton(place, name.replaceAll('-', ' '), () => chosen(toml, name));
    button.dataset.example = name;
    button.title = aboutOf(toml);
  }
}

/** A last button, which leads back to the user's own drive with all that was changed in it. */
export function offerOwn(place: HTMLElement, drive: DriveText, chosen: (drive: DriveText) => void): void {
  place.querySelector('[data-example=""]')?.remove();
  addButton(place, `your ${drive.name}`, () => chosen(drive)).dataset.example = '';
}

/** Marks the button of the example that is shown. */
export const markExample = (place: HTMLElement, name: string): void => markCurrent(place.querySelectorAll('button'), ({ dataset }) => dataset.example === name);
