// The guided story: seven steps, each with one control and one sentence.
import { addButton, byId, made, markCurrent } from './elements';
import { type Changed, Inputs, only } from './inputs';
import type { DriveText, Fault, Parameter } from './replies';

interface StoryStep {
  title: string;
  sentence: string;
  drive: DriveText;
  /** The one control. */
  path: string;
  /** The cards that it is seen in. */
  cards: string[];
}

const servo = (numbers: Record<string, string>, restitution = ''): string =>
  `[servo]\n${Object.entries(numbers).map(([key, value]) => `${key} = ${value}`).join('\n')}\n${restitution ? `\n[contact]\nrestitution = ${restitution}\n` : ''}`;

const sample = { damping: '0.19', inertia_ratio: '2', friction_ratio: '0.1', backlash: '"0.3 rad"', natural_frequency: '"14.5 rad/s"' };
const named = (toml: string, name: string): DriveText => ({ toml, name, settings: [] });

const step = (title: string, path: string, cards: string[], sentence: string, drive = named(servo(sample), 'story.toml')): StoryStep => ({ title, sentence, drive, path, cards });

export const storySteps = (joint: string): StoryStep[] => [
  step('The gap', 'servo.backlash', ['gears', 'time'],
    'Between the teeth there is a gap, the backlash: the motor turns through it before the load follows.'),
  step('The impact', 'contact.restitution', ['time', 'gears'],
    'When the gap closes, the faces strike each other; the restitution is the share of the speed with which they part again.',
    named(servo({ ...sample, damping: '0.1', inertia_ratio: '1', friction_ratio: '0.2' }, '0.3'), 'story.toml')),
  step('Growth at rest', 'servo.damping', ['phase', 'map'],
    'A tiny swing in the gap is multiplied by the growth at rest every half swing: above 1 it grows, below 1 it dies out.'),
  step('The cycle', 'servo.inertia_ratio', ['phase', 'gears'],
    'The swing grows until friction takes as much energy as the loop feeds in, and then repeats for ever: a limit cycle, the hunting.'),
  step('Friction', 'servo.friction_ratio', ['map', 'phase'],
    'Friction on the load damps the motion in the gap, where the motor’s friction and the loop cannot reach the load: the same total damping does more there.'),
  step('The sensor’s place', 'sensor.position', ['time', 'phase'],
    'A sensor on the motor does not feel the gap, so the loop stops hunting, but the load is then known only to within the gap.',
    named(joint, 'first-servo.toml')),
  step('The cure', 'servo.damping', ['changes', 'phase'],
    'Hunting ends at a border: the list shows, for each number of the servo, the nearest change that crosses it.'),
];

export class Story {
  private readonly inputs: Inputs;

  constructor(
    readonly steps: StoryStep[],
    private readonly goTo: (step: number) => void,
    changed: Changed,
  ) {
    this.inputs = new Inputs(byId('story-input'), changed, 'story-field');
  }

  /** Step `number`, from 1, with the control of its parameter. */
  show(number: number, parameters: Parameter[]): void {
    const step = this.steps[number - 1]!;
    const title = byId('story-title');
    title.textContent = `${number}. ${step.title}`;
    title.tabIndex = -1;
    byId('story-sentence').textContent = step.sentence;
    this.list(number);
    (byId('story-back') as HTMLButtonElement).disabled = number === 1;
    (byId('story-next') as HTMLButtonElement).disabled = number === this.steps.length;
    this.inputs.reset();
    this.update(number, parameters);
  }

  /** The present value of the step's control. */
  update(number: number, parameters: Parameter[]): void {
    const parameter = parameters.find((one) => one.path === this.steps[number - 1]!.path);
    if (parameter) this.inputs.show(only(parameter));
  }

  /** Marks the control; returns the faults that it does not show. */
  mark(faults: Fault[]): Fault[] {
    return this.inputs.mark(faults);
  }

  private list(present: number): void {
    const list = byId('story-steps');
    list.textContent = '';
    this.steps.forEach(({ title }, i) => {
      const item = made('li');
      addButton(item, `${i + 1}. ${title}`, () => this.goTo(i + 1));
      list.append(item);
    });
    markCurrent([list.children[present - 1]!.firstElementChild!], () => true, 'step');
  }
}
