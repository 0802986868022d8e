// A row of the table of controls: how a control is found, and what it changes.

import type { Locator } from '@playwright/test';
import type { Hand } from '../support/hands';
import type { Lab } from '../support/lab';

export type Work = (lab: Lab) => Promise<unknown>;

export interface Row {
  /** What the control changes. Anything that JSON can hold. */
  readonly see: (lab: Lab, locator: Locator) => unknown;
  /** What has to be done before. */
  readonly ready?: Work;
  /** What one does with it, if not what its role suggests. */
  readonly act?: (hand: Hand, locator: Locator) => Promise<unknown>;
  readonly after?: (lab: Lab, hand: Hand) => Promise<unknown>;
  /** Done twice, it is as before. */
  readonly isToggle?: boolean;
}

/** A control that the title of another test promises to use. */
export interface Elsewhere {
  readonly elsewhere: string;
}

/** By role and name. A name between slashes is a pattern. */
export type Rows = Record<string, Row | Elsewhere | readonly Row[]>;

export interface Section {
  readonly name: string;
  /** Opens what the controls are in. */
  readonly ready?: Work;
  /** The same before each row. */
  readonly rowReady?: Work;
  readonly rows: Rows;
}

export const isChecked = (_lab: Lab, locator: Locator) => locator.isChecked();
export const valueOf = (_lab: Lab, locator: Locator) => locator.inputValue();
export const expanded = (_lab: Lab, locator: Locator) => locator.getAttribute('aria-expanded');
export const dialogs = (lab: Lab) => lab.page.getByRole('dialog').count();
export const downloads = (lab: Lab) => lab.downloads;
export const tab = (name: string) => (lab: Lab) => lab.tab(name).click();
export const view = (name: string) => (lab: Lab) => lab.view(name).click();
/** The last message of a type, or null. */
export const lastSent = (type: string) => (lab: Lab) => lab.sent[type] ?? null;

export const toggle = (see: Row['see'], ready?: Work): Row => ({
  see,
  isToggle: true,
  ...(ready ? { ready } : {}),
});
