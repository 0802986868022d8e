// The controls of the page by their names.

import type { Locator, Page } from '@playwright/test';
import { Stepper } from './stepper';

/** Panels under the tab *Test*. */
const TESTS: readonly string[] = ['Compare', 'Recovery', 'Disturb'];
export type Panel =
  'Now' | 'Story' | 'Learn' | 'Play' | 'Compare' | 'Recovery' | 'Disturb' | 'Tune';

export class LabControls extends Stepper {
  readonly canvas: Locator;
  downloads = 0;

  constructor(page: Page) {
    super(page);
    this.canvas = page.getByLabel('Workspace', { exact: true });
    page.on('download', () => (this.downloads += 1));
  }

  button(name: string) {
    return this.page.getByRole('button', { name, exact: true });
  }

  tab(name: string) {
    return this.page.getByRole('tab', { name, exact: true });
  }

  /** Opens a panel of the inspector. */
  async panel(name: Panel) {
    const isTest = TESTS.includes(name);
    await this.tab(isTest ? 'Test' : name).click();
    if (isTest) await this.radio(name).check();
  }

  view(name: string) {
    return this.page
      .getByRole('navigation', { name: 'Views' })
      .getByRole('link', { name, exact: true });
  }

  radio(name: string) {
    return this.page.getByRole('radio', { name, exact: true });
  }

  spin(name: string) {
    // The name of a changed parameter ends in a dot.
    const words = name.replaceAll(/[.*+?^${}()|[\]\\]/g, '\\$&');
    return this.page.getByRole('spinbutton', { name: new RegExp(`^${words}( •)?$`) });
  }

  label(name: string) {
    return this.page.getByLabel(name, { exact: true });
  }

  notice(place: string) {
    return this.page.locator(`[data-place=${place}] .notice`);
  }

  /** In the panel *Set up*. */
  mapChoice(name: string) {
    const maps = this.page.getByRole('radiogroup', { name: 'Map' });
    return maps.getByRole('radio', { name, exact: true });
  }

  get setUpButton() {
    return this.page.getByTitle('Set up: map, preset, seed');
  }

  /** Opens or closes the panel *Set up*. */
  async setUp() {
    await this.setUpButton.click();
  }
}
