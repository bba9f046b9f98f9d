// Elements of the page.

export const byId = <T extends Element = HTMLElement>(id: string): T => document.getElementById(id) as unknown as T;

/** A button at the end of `place`. */
export function addButton(place: Element, text: string, clicked: () => void): HTMLButtonElement {
  const button = document.createElement('button');
  button.type = 'button';
  button.textContent = text;
  button.onclick = clicked;
  place.append(button);
  return button;
}

/** Marks one of several buttons, or none. */
export function markCurrent(buttons: Iterable<Element>, isCurrent: (button: HTMLElement) => boolean, word = 'true'): void {
  for (const button of buttons as Iterable<HTMLElement>) {
    if (isCurrent(button)) button.setAttribute('aria-current', word);
    else button.removeAttribute('aria-current');
  }
}
