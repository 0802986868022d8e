// The page for a refused request, in the user's colours.

import { createTheme } from '../../ui/theme';

createTheme();
