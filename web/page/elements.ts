// Elements of the page.

export const byId = <T extends Element = HTMLElement>(id: string): T => document.getElementById(id) as unknown as T;

/** A new element with these properties. */
export const made = <Tag extends keyof HTMLElementTagNameMap>(tag: Tag, properties: Partial<HTMLElementTagNameMap[Tag]> = {}): HTMLElementTagNameMap[Tag] =>
  Object.assign(document.createElement(tag), properties);

/** A button at the end of `place`. */
export function addButton(place: Element, text: string, clicked: () => void): HTMLButtonElement {
  const button = made('button', { type: 'button', textContent: text, onclick: clicked });
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
