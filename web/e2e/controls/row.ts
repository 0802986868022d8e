// A row of the control table: how a test uses a control, and what the control changes.

import type { Locator } from '@playwright/test';
import type { InputMethod } from '../support/inputMethods';
import type { Lab } from '../support/lab';

export type Work = (lab: Lab) => Promise<unknown>;

export interface Row {
  /** Reads the value that the control changes. The tests compare it as JSON. */
  readonly see: (lab: Lab, locator: Locator) => unknown;
  /** Runs before the control is used. */
  readonly ready?: Work;
  /** Uses the control. If missing, the test does what fits the control's role. */
  readonly act?: (input: InputMethod, locator: Locator) => Promise<unknown>;
  /** Runs after the value has changed. */
  readonly after?: (lab: Lab, input: InputMethod) => Promise<unknown>;
  /** A second use restores the value. */
  readonly isToggle?: boolean;
}

/** A control that another test uses: the one with this title. */
export interface Elsewhere {
  readonly elsewhere: string;
}

/** Keys are role and accessible name. A name between slashes is a regular expression. */
export type Rows = Record<string, Row | Elsewhere | readonly Row[]>;

/** In place of a title, for a control that appears too late for a test. */
export const NOT_TESTED = 'not tested';

export interface Section {
  readonly name: string;
  /** Opens the part of the page that has the controls. Runs once. */
  readonly ready?: Work;
  /** Runs before each row. */
  readonly rowReady?: Work;
  /** Runs after the last row. */
  readonly after?: (lab: Lab, input: InputMethod) => Promise<unknown>;
  readonly rows: Rows;
}

export const isChecked = (_lab: Lab, locator: Locator) => locator.isChecked();
export const isPressed = (_lab: Lab, locator: Locator) => locator.getAttribute('aria-pressed');
export const valueOf = (_lab: Lab, locator: Locator) => locator.inputValue();
export const expanded = (_lab: Lab, locator: Locator) => locator.getAttribute('aria-expanded');
export const dialogs = (lab: Lab) => lab.page.getByRole('dialog').count();
export const downloads = (lab: Lab) => lab.downloads;
export const isSelected = (_lab: Lab, locator: Locator) => locator.getAttribute('aria-selected');
export const view = (name: string) => (lab: Lab) => lab.view(name).click();
/** The last message of a type, or null. */
export const lastSent = (type: string) => (lab: Lab) => lab.sent[type] ?? null;

export const toggle = (see: Row['see'], ready?: Work): Row => ({
  see,
  isToggle: true,
  ...(ready ? { ready } : {}),
});
