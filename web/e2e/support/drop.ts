import type { Page } from '@playwright/test';

/** Drops a text file on the page. */
export async function dropFile(page: Page, name: string, type: string, text: string) {
  const dataTransfer = await page.evaluateHandle(
    (file) => {
      const transfer = new DataTransfer();
      transfer.items.add(new File([file.text], file.name, { type: file.type }));
      return transfer;
    },
    { name, type, text },
  );
  await page.dispatchEvent('main', 'drop', { dataTransfer });
}
