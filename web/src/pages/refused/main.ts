// The page for a refused request, in the user's colours.

import { theme } from '../../ui/theme';

theme();
